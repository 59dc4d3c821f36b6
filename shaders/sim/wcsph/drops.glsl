// Bodies of connected fluid, and sums over each: sim/methods/wcsph/drops.c. Eight numbers per particle: a way to the root of its
// body; of roots the tally, and the sum of forces in steps, 64 bits along each axis.
#include "shaders/sim/wcsph/drops_block.h"
layout(std430, binding = DROPS_BUFFER) coherent buffer Drops { uint drop[]; };
#define DROP_TALLY   1u
#define DROP_SUM     2u
#define DROP_NUMBERS 8u

uint drop_at(uint number, uint i) { return number * particles_there() + i; }

// The root of i; halves the way there.
uint drop_root(uint i)
{
    uint next = drop[i];
    while (next != i) {
        uint after = drop[next];
        if (after != next)
            drop[i] = after;
        i = next;
        next = after;
    }
    return i;
}

// Joins two bodies; others may join them meanwhile. Returns the root.
uint drop_join(uint a, uint b)
{
    while (true) {
        a = drop_root(a);
        b = drop_root(b);
        uint low = min(a, b), high = max(a, b);
        if (low == high || atomicCompSwap(drop[high], high, low) == high)
            return low;
    }
}

float drop_scale(uint fluid)
{
    float most = fluid_terms[fluid].tension * curvature_most;
    return most > 0.0 ? DROP_STEPS / most : 0.0;
}

// Bits of the axes with a wall within the support of x.
uint drop_walls(vec3 x)
{
    vec3 d = half_size - abs(vec3(x.x, x.y - half_size.y, x.z));
    bvec3 near_wall = lessThan(d, vec3(support));
#ifdef PERIODIC
    near_wall = bvec3(near_wall.x && !periodic.x, near_wall.y && !periodic.y, near_wall.z && !periodic.z);
#endif
    return uint(near_wall.x) + 2u * uint(near_wall.y) + (dimensions == 2 ? 0u : 4u * uint(near_wall.z));
}

void drop_add_along(uint at, int steps)
{
    if (steps == 0)
        return;
    uint more = uint(steps), before = atomicAdd(drop[at], more);
    uint high = (before + more < more ? 1u : 0u) + (steps < 0 ? 0xffffffffu : 0u);
    if (high != 0u)
        atomicAdd(drop[drop_at(1u, at)], high);
}

// Adds a force on particle i at x to the sums of its body.
void drop_add(uint i, vec3 x, vec3 force, uint fluid)
{
    uint root = drop_root(i), walls = drop_walls(x);
    ivec3 steps = ivec3(roundEven(clamp(drop_scale(fluid) * force, vec3(-DROP_MOST), vec3(DROP_MOST))));
    for (int k = 0; k < 3; k++)
        drop_add_along(drop_at(DROP_SUM + 2u * uint(k), root), steps[k]);
    atomicAdd(drop[drop_at(DROP_TALLY, root)], DROP_ONE);
    if (walls != 0u)
        atomicOr(drop[drop_at(DROP_TALLY, root)], walls);
}

// A sum of 64 bits.
float drop_sum(uint at)
{
    uint low = drop[at], high = drop[drop_at(1u, at)];
    bool negative = high >= 0x80000000u;
    if (negative) {
        high = ~high + (low == 0u ? 1u : 0u);
        low = ~low + 1u;
    }
    float sum = 4294967296.0 * float(high) + float(low);
    return negative ? -sum : sum;
}
