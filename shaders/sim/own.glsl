// What the method keeps of each particle in columns of its own (Method.columns: saved or sorted), one behind the other:
// own[OWN_age + i] is the column `age` of particle i; of one with three components the next is own[OWN_STRIDE + OWN_age + i].
// sim/gl/compute/own.c writes the defines. OWN_ACCESS: what a pass does with them, if not both.
#include "shaders/sim/bindings.h"
#ifndef OWN_ACCESS
#define OWN_ACCESS
#endif
layout(std430, binding = OWN_BUFFER) OWN_ACCESS buffer Own { float own[]; };
