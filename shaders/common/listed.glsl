// The particles to be drawn: all, or with LISTED those that culling kept (render/splat/cull.c), in the same order.
#ifdef LISTED
layout(std430, binding = 3) readonly buffer Listed { uint listed[]; };
#endif

uint listed_particle(uint i)
{
#ifdef LISTED
    return listed[i];
#else
    return i;
#endif
}
