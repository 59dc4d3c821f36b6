// A line for each seed of a lattice: steps of one length by Runge and Kutta's fourth order, along the direction of the mean
// velocity, both ways from the seed. The seed is the middle point. Where a line ends, the other points repeat the last one.
// With FASTEST: only the greatest speed of all seeds.
#include "common/mean.glsl"
#include "common/sample_grid.glsl"
#include "shaders/streamlines/streamlines_bindings.h"

layout(std430, binding = STREAM_FASTEST_STORAGE) buffer Fastest { uint fastest; }; // bits of m/s, in the order of the numbers
layout(location = STREAM_NORMAL_AT) uniform vec3 normal; // lines keep to the plane across the unit vector; 0: no plane

vec3 velocity_of(Mean mean)
{
    vec3 velocity = mean.weight >= mean_least ? mean.vector / mean.weight : vec3(0.0);
    return velocity - dot(velocity, normal) * normal;
}

#ifdef FASTEST
void main()
{
    uint i = invocation();
    if (!beyond_sample_grid(i))
        atomicMax(fastest, floatBitsToUint(length(velocity_of(mean_at(sample_grid_place(i))))));
}
#else
layout(std430, binding = STREAM_POINTS_STORAGE) buffer Points { vec4 points[]; }; // x y z in the box's frame, m; scalar
layout(location = STREAM_STEP_AT) uniform float step_length;
layout(location = STREAM_STEPS_AT) uniform uint steps;
layout(location = STREAM_BEGUN_AT) uniform uint begun; // steps made by earlier runs
layout(location = STREAM_SLOWEST_AT) uniform float slowest;
layout(location = STREAM_LEAST_AT) uniform vec3 least;
layout(location = STREAM_GREATEST_AT) uniform vec3 greatest;

const uint closes_after = 8u; // steps

// A unit vector; 0 where the fluid rests or there is none.
vec3 way_of(Mean mean)
{
    vec3 velocity = velocity_of(mean);
    float speed = length(velocity);
    return speed > slowest * uintBitsToFloat(fastest) ? velocity / speed : vec3(0.0);
}

// The next point, `by` metres on; false where the line ends.
bool advance(inout vec3 x, inout Mean mean, float by)
{
    vec3 k1 = way_of(mean), k2 = way_of(mean_at(x + 0.5 * by * k1)), k3 = way_of(mean_at(x + 0.5 * by * k2));
    vec3 k4 = way_of(mean_at(x + by * k3)), next = x + by / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    // a turn by more than a right angle in one step: a place of rest
    if (dot(k1, k2) <= 0.0 || dot(k1, k3) <= 0.0 || dot(k1, k4) <= 0.0)
        return false;
    Mean there = mean_at(next);
    if (way_of(there) == vec3(0.0) || any(lessThan(next, least)) || any(greaterThan(next, greatest)))
        return false;
    x = next;
    mean = there;
    return true;
}

// An invocation each way. One run makes a few steps: a software driver leaves a shader's loops after 65,535 rounds in all.
void main()
{
    uint i = invocation(), line = i / 2u, end = min(begun + STREAM_STEPS_A_RUN, steps);
    int side = (i & 1u) == 0u ? 1 : -1;
    if (beyond_sample_grid(line))
        return;
    uint middle = line * (2u * steps + 1u) + steps, last = middle + uint(side * int(begun));
    vec3 x = begun == 0u ? sample_grid_place(line) : points[last].xyz;
    Mean mean = mean_at(x);
    vec4 point = vec4(x, shown_of(mean)), seed = begun == 0u ? point : points[middle];
    bool goes = way_of(mean) != vec3(0.0);
    if (begun == 0u)
        points[middle] = seed;
    else
        goes = x != seed.xyz && x != points[last - uint(side)].xyz;
    for (uint k = begun + 1u; k <= end; k++) {
        goes = goes && advance(x, mean, float(side) * step_length);
        if (goes)
            point = vec4(x, shown_of(mean));
        if (goes && k > closes_after && distance(x, seed.xyz) < 0.75 * step_length) {
            point = seed;
            goes = false;
        }
        points[middle + uint(side * int(k))] = point;
    }
}
#endif
