// Positions in wide boxes with rounding remainders: sim/box/box.h. In smaller boxes remainders are lost.
#ifdef WIDE
#include "sim/own.glsl"

vec3 left_of(uint i)
{
    return vec3(own[OWN_remainder + i], own[OWN_remainder + OWN_STRIDE + i], own[OWN_remainder + 2u * OWN_STRIDE + i]);
}

void keep_left(uint i, vec3 left)
{
    for (uint a = 0u; a < 3u; a++)
        own[OWN_remainder + a * OWN_STRIDE + i] = left[a];
}

void place_move(inout vec3 x, inout vec3 left, vec3 way)
{
    precise vec3 sum = x + way, added = sum - x;
    precise vec3 all = left + ((x - (sum - added)) + (way - added));
    precise vec3 there = sum + all, rest = all - (there - sum);
    x = there;
    left = rest;
}

// For a position set from `before` to x.
void place_put(vec3 before, vec3 x, inout vec3 left)
{
    left = mix(left, vec3(0), notEqual(before, x));
}

vec3 place_after(uint i, vec3 x, vec3 way)
{
    vec3 left = left_of(i);
    place_move(x, left, way);
    keep_left(i, left);
    return x;
}
#else
#define left_of(i)              vec3(0)
#define keep_left(i, left)
#define place_move(x, left, way) x += way
#define place_put(before, x, left)
#define place_after(i, x, way)  (x) + (way)
#endif
