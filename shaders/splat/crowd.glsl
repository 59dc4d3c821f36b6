// The crowding around a particle: the sum of its neighbours' weights, continuous as neighbours come and go.
#include "shaders/splat/splat_bindings.h"
layout(location = SUPPORT_RADIUS_AT) uniform float support_radius; // h, m
layout(location = FULL_SUM_AT) uniform float full_sum;             // a particle with at least this sum is no drop
layout(location = CROWD_RADIUS_AT) uniform float full_radius;      // radius of a particle in the fluid, m
layout(location = DROP_RADIUS_AT) uniform float drop_radius;       // radius of an isolated particle, m

// After: Yu and Turk 2013, eq. 11; q = r / h.
float near_weight(float q2)
{
    return max(1.0 - q2 * sqrt(q2), 0.0);
}

// 0 for an isolated particle, 1 in the fluid.
float crowd_share(float sum)
{
    return smoothstep(0.0, full_sum, sum);
}

float crowd_radius(float share)
{
    return mix(drop_radius, full_radius, share);
}
