// Shared by the shaders of foam.
#include "common/nan.glsl"
#include "shaders/clear/foam_bindings.h"
