// How crowded it is around a particle: the sum of its neighbours' weights, which is continuous where one comes or goes.
layout(location = 3) uniform vec4 sizes;  // support radius h, m; sum from which on a particle is no drop; radius of it and of a drop, m

// After: Yu and Turk 2013, eq. 11; q = r / h.
float near_weight(float q2)
{
    return max(1.0 - q2 * sqrt(q2), 0.0);
}

// 0 for a particle alone, 1 in the fluid.
float crowd_share(float sum)
{
    return smoothstep(0.0, sizes.y, sum);
}

float crowd_radius(float share)
{
    return mix(sizes.w, sizes.z, share);
}
