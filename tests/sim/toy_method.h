/* A method that the program does not have: springs that harden with the age of their particles, a column of
   its own. */
#ifndef SLOSH_TESTS_TOY_METHOD_H
#define SLOSH_TESTS_TOY_METHOD_H

#include "sim/cpu/pass.h"
#include "sim/world/substep.h"

static void body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        p->own[0][i] += range->input->dt * (float)p->id[i];
        p->own[1][i] = 50 + 1000 * p->own[0][i];
        p->ax[i] = -p->own[1][i] * p->x[i];
        p->volume[i] = 1 / range->cpu->constants->rest_number_density;
    }
}

static const CpuPass on_cpu = {.loops = {{body, CPU_GRAIN}}};
static const Pass spring = {.name = "spring",
                            .cpu = &on_cpu,
                            .shader = "toy/spring",
                            .reads = "position id age",
                            .writes = "age stiffness volume acceleration"};
enum { KEPT = COLUMN_SAVED | COLUMN_SORTED };
static const ColumnDef columns[] = {{"age", "s", COLUMN_OWN(0), 1, .flags = KEPT},
                                    {"stiffness", "1/s2", COLUMN_OWN(1), 1, .flags = COLUMN_SHADERS},
                                    {0}};

static void substep(const Substep *step)
{
    step->backend->drift(step->state, &step->first_half);
    step->backend->grid(step->state);
    substep_run(step, &spring, step->dt);
    substep_kick(step);
    step->backend->drift(step->state, &step->second_half);
}

static Method toy = {.name = "toy",
                     .help = "springs that harden",
                     .columns = columns,
                     .passes = (const Pass *const[]){&spring, NULL},
                     .settle = &spring,
                     .substep = substep};

#endif
