// The particles to draw: all, or with LISTED the particles of a list, in the same order.
#include "shaders/shared/bindings.h"
#ifdef LISTED
layout(std430, binding = LISTED_STORAGE) readonly buffer Listed { uint listed[]; };
#endif

uint listed_particle(uint i)
{
#ifdef LISTED
    return listed[i];
#else
    return i;
#endif
}
