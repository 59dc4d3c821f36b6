// The kernel of density, and that of pressure: sim/methods/mueller/pairs_mueller.c.
#include "sim/shapes.glsl"
#ifdef KERNEL_QUINTIC
// W over W(0).
float weight(vec3 d) { return height(min(length(d) * inverse_support, 1.0)); }

// Force of pressure, over d.
float push_of(float terms, float r) { return pressure_scale * shape(min(r * inverse_support, 1.0)) * terms; }
#else
float weight(vec3 d)
{
    float q2 = dot(d, d) * inverse_support * inverse_support;
#ifdef POLY6
    float t = max(1.0 - q2, 0.0);
#else
    float t = max(1.0 - sqrt(q2), 0.0);
#endif
    return t * t * t;
}

float push_of(float terms, float r)
{
    float t = max(1.0 - r * inverse_support, 0.0);
    return pressure_scale * (t * t) * terms / r;
}
#endif
