// Columns kept by the method (Method.columns: saved or sorted), in sequence: own[OWN_age + i] is the column `age` of
// particle i. The second of three components is own[OWN_STRIDE + OWN_age + i]. sim/gpu/compute/buffers.c writes the
// defines. OWN_ACCESS: access of the pass, if not read and write.
#include "shaders/sim/bindings.h"
#ifndef OWN_ACCESS
#define OWN_ACCESS
#endif
layout(std430, binding = OWN_BUFFER) OWN_ACCESS buffer Own { float own[]; };
