// The coarse level: matrix and residuals of a cell's corners, from sums over the cell's particles. A group per cell, an invocation
// per sum: CoarseSums and fill_matrix of sim/cpu/coarse.c.
#include "sim/constants.glsl"
#include "sim/cells.glsl"
#include "sim/coarse.glsl"
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = STARTS_BUFFER) readonly buffer Starts { uint start[]; };
layout(std430, binding = COARSE_TERMS_BUFFER) readonly buffer CoarseTerms { vec4 term[]; }; // weight, hold, residual
layout(std430, binding = COARSE_CELLS_BUFFER) writeonly buffer CoarseCells { float cell_of_level[]; };
shared float sums[64];

#define SUM_SLOPES 0u // sum weight q q, by axis: over the two other axes
#define SUM_HOLDS 27u // sum hold q q q
#define SUM_RESIDUALS 54u // sum residual l l l
#define WHOLE_WEIGHT 62u
#define WHOLE_HOLD 63u

// As factors of 1, x, x^2. q: products of two corners' functions; l: a corner's function.
const vec3 one = vec3(1, 0, 0), q[3] = vec3[](vec3(1, -2, 1), vec3(0, 1, -1), vec3(0, 0, 1)),
           l[2] = vec3[](vec3(1, -1, 0), vec3(0, 1, 0));

struct Sum {
    vec3 of; // weight, hold, residual: the one that counts
    vec3 along[3];
};

Sum sum_of(uint own)
{
    uint k = own < SUM_HOLDS ? own : own - SUM_HOLDS, c = own - SUM_RESIDUALS;
    uvec3 digit = uvec3(k / 9u, k / 3u % 3u, k % 3u);
    if (own == WHOLE_WEIGHT)
        return Sum(vec3(1, 0, 0), vec3[](one, one, one));
    if (own == WHOLE_HOLD)
        return Sum(vec3(0, 1, 0), vec3[](one, one, one));
    if (own >= SUM_RESIDUALS)
        return Sum(vec3(0, 0, 1), vec3[](l[c & 1u], l[c >> 1 & 1u], l[c >> 2]));
    if (own >= SUM_HOLDS)
        return Sum(vec3(0, 1, 0), vec3[](q[digit.x], q[digit.y], q[digit.z]));
    vec3 first = q[digit.y], second = q[digit.z];
    return Sum(vec3(1, 0, 0), digit.x == 0u ? vec3[](one, first, second) : digit.x == 1u ? vec3[](first, one, second) : vec3[](first, second, one));
}

float part_of(Sum sum, uint i, ivec3 cell)
{
    vec3 at = coarse_place(position[i].xyz, cell), part;
    for (int k = 0; k < 3; k++)
        part[k] = dot(sum.along[k], vec3(1, at[k], at[k] * at[k]));
    return dot(sum.of, term[i].xyz) * part.x * part.y * part.z;
}

// sum weight h grad . h grad + hold, of two corners.
float entry(uint own, ivec3 cell)
{
    uvec3 a = uvec3(own >> 3) >> uvec3(0, 1, 2) & 1u, b = uvec3(own) >> uvec3(0, 1, 2) & 1u, both = a + b;
    vec3 over = cell_inverse * support / vec3(coarse_width(cell));
    uvec3 other = uvec3(3u * both.y + both.z, 3u * both.x + both.z, 3u * both.x + both.y);
    float found = sums[SUM_HOLDS + 9u * both.x + 3u * both.y + both.z];
    for (int k = 0; k < dimensions; k++)
        found += (a[k] == b[k] ? 1.0 : -1.0) * over[k] * over[k] * sums[SUM_SLOPES + 9u * uint(k) + other[k]];
    return found;
}

void main()
{
    uint own = gl_LocalInvocationID.x, number = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    if (number >= uint(COARSE_COUNT.x * COARSE_COUNT.y * COARSE_COUNT.z))
        return;
    int row = int(number) / COARSE_COUNT.x;
    ivec3 cell = ivec3(int(number) % COARSE_COUNT.x, row % COARSE_COUNT.y, row / COARSE_COUNT.y);
    ivec3 first = cell * COARSE_WIDE + 1, end = first + coarse_width(cell);
    Sum sum = sum_of(own);
    float found = 0.0;
    for (int z = first.z; z < end.z; z++)
        for (int y = first.y; y < end.y; y++) {
            int place = cell_place(ivec3(first.x, y, z));
            uint last = start[place + end.x - first.x];
            for (uint i = start[place]; i < last; i++) {
                ivec3 at = cell_of(position[i].xyz); // cells may share places: sim/step/backend.h
                if (at.y == y && at.z == z && at.x >= first.x && at.x < end.x)
                    found += part_of(sum, i, cell);
            }
        }
    sums[own] = found;
    barrier();
    uint to = number * COARSE_CELL_FLOATS;
    cell_of_level[to + own] = entry(own, cell);
    if (own >= SUM_RESIDUALS)
        cell_of_level[to + 64u + own - SUM_RESIDUALS] = found;
}
