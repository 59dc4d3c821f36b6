// Decides if a solver goes on, from the sums of excess.comp after its last iteration, and the next step of conjugate
// gradients: substep_iterate and `conjugate` of sim/step/iterate.c. A single group.
#include "sim/constants.glsl"
#include "common/nan.glsl"
#include "shaders/sim/excess_part.h"
#include "shaders/sim/solve_block.h"
layout(std430, binding = PARTS_BUFFER) readonly buffer Parts { ExcessPart part[]; };
shared vec4 sums[64]; // sum, greatest, power, curvature
shared float scales[64];

// True if the solver goes on.
bool decide(float mean, float greatest)
{
    iterations++;
    left_mean = mean;
    left_most = greatest;
    particles = particles_there();
    bool far = is_nan(mean) || mean > tolerance || (greatest > worst && iterations < iterations_few);
    if (iterations < iterations_most && far)
        return true;
    ended = 1u;
    pass_groups.along = sum_groups.along = decision_groups.along = 0u;
    return false;
}

void conjugate(float next_power, float curvature)
{
    turn = power != 0.0 ? next_power / power : 0.0;
    float bent = curvature - (turn != 0.0 && go != 0.0 ? turn * next_power / go : 0.0);
    go = bent > 0.0 ? next_power / bent : 0.0;
    power = next_power;
}

// A coarse correction is due: is_slow of sim/step/iterate.c.
bool is_slow()
{
    float part = left_mean / left_second, left = left_mean / tolerance;
    for (int k = 0; k < COARSE_WORTH; k++)
        left *= sqrt(part);
    return coarse != 0u && iterations % COARSE_EVERY == COARSE_AFTER && left > 1.0;
}

void decide_coarse(bool goes_on)
{
    uint due = goes_on && is_slow() ? 1u : 0u;
    coarse_groups.along = due * pass_groups_along;
    coarse_cell_groups.along = due * coarse_cell_groups_along;
    coarse_solve_groups.along = due;
    left_second = left_before;
    left_before = left_mean;
}

// 1 / (unit of the residual).
float scale_of(float sum) { return scaled == 0u || sum == 0.0 ? 1.0 : float(particles_there()) / sum; }

void main()
{
    uint own = gl_LocalInvocationID.x, parts = sum_groups_along;
    vec4 found = vec4(0);
    scales[own] = 0.0;
    for (uint k = own; k < parts; k += 64u) {
        found = vec4(found.x + part[k].above, max(found.y, part[k].greatest), found.zw + vec2(part[k].power, part[k].curvature));
        scales[own] += part[parts * EXCESS_OF_SCALE + k].above;
    }
    sums[own] = found;
    for (uint half_count = 32u; half_count > 0u; half_count >>= 1u) {
        barrier();
        if (own < half_count) {
            vec4 one = sums[own], other = sums[own + half_count];
            sums[own] = vec4(one.x + other.x, max(one.y, other.y), one.zw + other.zw);
            scales[own] += scales[own + half_count];
        }
    }
    if (own > 0u)
        return;
    float scale = scale_of(scales[0]);
    bool goes_on = decide(scale * (sums[0].x / max(float(particles_there()), 1.0)), scale * sums[0].y);
    decide_coarse(goes_on);
    if (goes_on)
        conjugate(sums[0].z, sums[0].w);
}
