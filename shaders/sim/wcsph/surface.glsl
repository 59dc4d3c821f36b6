// Normals of the surfaces; their length is their weight: sim/methods/wcsph/pairs_surface.c. Solids are not part of a surface.
layout(std430, binding = OUTWARDS_BUFFER) OUTWARD_ACCESS buffer Outwards { vec4 outward[]; };

#ifdef LISTS
#define WALK_OWN_FLUID(i, x, at, meet) WALK_LISTED(i, x, at, meet)
#else
#define WALK_OWN_FLUID(i, x, at, meet) WALK_FLUID(x, at, meet)
#endif

// (1 - r/h)^3, the slope of Wendland's C2 over r.
float surface_slope(float r2)
{
    float t = max(1.0 - sqrt(r2) * inverse_support, 0.0);
    return t * t * t;
}
