/* Accelerations, and with shifting what that goes by. */
#include "sim/wcsph/passes.h"

#include <math.h>

PAIR_LOOPS(wcsph_force);
PAIR_LOOPS(wcsph_images_force);

/* 0 where less than 0.8 of the space around is full, at a surface; 1 from 0.95 on. */
static float share_of(float full)
{
    return fminf(fmaxf((full - 0.8f) / 0.15f, 0), 1);
}

static void complete_shift(const Cpu *cpu, size_t i)
{
    const Constants *s = cpu->constants;
    float *const *own = cpu->now.own;
    const float share = share_of(own[FULL][i] / ((float)s->dimensions * s->rest_number_density));
    for (int k = 0; k < 3; k++)
        own[UNEVEN + k][i] *= share;
    own[DENSE][i] = own[DENSE][i] / s->rest_number_density - 1;
    own[FULL][i] = share;
}

static void force_body(const CpuRange *range)
{
    cpu_pairs(range, &wcsph_force);
    cpu_pairs(range, &wcsph_images_force);
    if (range->cpu->now.own[FULL])
        for (size_t i = range->begin; i < range->end; i++)
            complete_shift(range->cpu, i);
    cpu_force_end(range);
}

static const CpuPass force = {.loops = {{force_body, .walks = true}}};

const Pass wcsph_forces = {
    .name = "force",
    .stage = STAGE_FORCE,
    .cpu = &force,
    .shader = "wcsph/force",
    .reads = "position velocity id fluid volume pressure pressure_term viscosity artificial tension kind",
    .writes = "acceleration uneven full dense",
    .mirrors = true,
};
