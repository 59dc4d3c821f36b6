/* A method in a single file: springs that harden with the particles' age. Registers in the list. */
#ifndef SLOSH_TESTS_TOY_METHOD_H
#define SLOSH_TESTS_TOY_METHOD_H

#include "sim/base/key_rows.h"
#include "sim/cpu/cpu.h"
#include "sim/step/substep.h"

static const double soft = 50; /* a single number as settings */
static const Key spring_keys[] = {NUMBER("solver.springs", L, "1/s2", 0, 1000, 0, "stiffness when new"),
                                  KEYS_END};
static Method toy;

static void spring_constants(Constants *constants, const WorldDef *def)
{
    *(float *)(void *)constants->of_method = (float)*(double *)method_def(def, &toy);
}

static void body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    for (size_t i = range->begin; i < range->end; i++) {
        p->own[0][i] += range->input->dt * (float)p->id[i];
        p->own[1][i] = *(const float *)(const void *)range->cpu->constants->of_method + 1000 * p->own[0][i];
        p->ax[i] = -p->own[1][i] * p->x[i];
        p->volume[i] = 1 / range->cpu->constants->rest_number_density;
    }
}

/* clang-format off */
static const CpuPass on_cpu = {.loops = {{body}}};
static const Pass spring = {.name = "spring", .stage = STAGE_FORCE, .cpu = &on_cpu, .shader = "toy/spring",
                            .reads = "position id age", .writes = "age stiffness volume acceleration"};
static const ColumnDef of_spring[] = {{"age", "s", COLUMN_OWN(0), 1, .flags = COLUMN_SAVED | COLUMN_SORTED},
                                      {"stiffness", "1/s2", COLUMN_OWN(1), 1, .flags = COLUMN_SHADERS}, {0}};

static void substep(const Substep *step)
{
    step->backend->drift(step->state, &step->first_half);
    step->backend->grid(step->state);
    STAGE (step->clock, STAGE_FORCE)
        substep_run(step, &spring, step->dt);
    substep_kick(step);
    step->backend->drift(step->state, &step->second_half);
}

static Method toy = {.name = "toy", .help = "springs that harden",
                     .keys = spring_keys, .def = &soft, .def_size = sizeof soft,
                     .constants = spring_constants, .columns = of_spring,
                     .passes = (const Pass *const[]){&spring, NULL}, .settle = &spring, .substep = substep};
/* clang-format on */

/* Before the first scene is read. */
static void toy_method_add(void)
{
    method_add(&toy);
}

#endif
