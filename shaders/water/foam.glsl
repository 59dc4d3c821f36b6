// Shared by the shaders of foam.
#include "common/nan.glsl"
#include "shaders/water/foam_bindings.h"
