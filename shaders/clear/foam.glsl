// What the shaders of foam share.
#include "common/nan.glsl"
#include "shaders/clear/foam_bindings.h"
