// How crowded it is around a particle: the sum of its neighbours' weights, which is continuous where one comes or goes.
#include "shaders/splat/splat_bindings.h"
layout(location = SUPPORT_RADIUS_AT) uniform float support_radius; // h, m
layout(location = FULL_SUM_AT) uniform float full_sum;             // from which on a particle is no drop
layout(location = CROWD_RADIUS_AT) uniform float full_radius;      // of a particle that is none, m
layout(location = DROP_RADIUS_AT) uniform float drop_radius;       // of one alone, m

// After: Yu and Turk 2013, eq. 11; q = r / h.
float near_weight(float q2)
{
    return max(1.0 - q2 * sqrt(q2), 0.0);
}

// 0 for a particle alone, 1 in the fluid.
float crowd_share(float sum)
{
    return smoothstep(0.0, full_sum, sum);
}

float crowd_radius(float share)
{
    return mix(drop_radius, full_radius, share);
}
