// Scratch columns of the method (Method.columns: COLUMN_SHADERS), computed in each step: scratch[SCRATCH_stiffness +
// i]. Same layout as own.glsl.
#include "shaders/sim/bindings.h"
layout(std430, binding = SCRATCH_BUFFER) buffer Scratch { float scratch[]; };
