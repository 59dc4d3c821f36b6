// Scratch of the method's own (Method.columns: COLUMN_SHADERS), which each step makes anew, as own.glsl has what it keeps:
// scratch[SCRATCH_stiffness + i].
#include "shaders/sim/bindings.h"
layout(std430, binding = SCRATCH_BUFFER) buffer Scratch { float scratch[]; };
