#include "sim/cpu/cpu.h"
#include "sim/methods/shared/terms.h"
#include "sim/step/substep.h"

#include <math.h>

enum { ACCELERATION = COLUMNS_SHOWN };

static bool named(const WorldDef *def)
{
    return def->acceleration;
}

static bool needed(const Constants *constants)
{
    return constants->accelerations;
}

const ColumnDef change_columns[] = {
    {"acceleration", "m/s2", .at = COLUMN_OWN(ACCELERATION), 3, COLUMN_FLOAT,
     .flags = COLUMN_SAVED | COLUMN_SORTED, .needed = needed},
    {0},
};

static void begin_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    float *const v[3] = {p->vx, p->vy, p->vz};
    for (int k = 0; k < 3; k++)
        for (size_t i = range->begin; i < range->end; i++)
            p->own[ACCELERATION + k][i] = v[k][i];
}

static void end_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    float *const v[3] = {p->vx, p->vy, p->vz};
    const float dt = range->input->dt;
    for (int k = 0; k < 3; k++) {
        float *a = p->own[ACCELERATION + k];
        for (size_t i = range->begin; i < range->end; i++)
            a[i] = dt > 0 ? (v[k][i] - a[i]) / dt : NAN;
    }
}

static const CpuPass begin_cpu = {.loops = {{begin_body}}}, end_cpu = {.loops = {{end_body}}};

const Pass change_begin = {
    .name = "change begin",
    .stage = STAGE_INTEGRATE,
    .cpu = &begin_cpu,
    .shader = "change/begin",
    .reads = "velocity",
    .writes = "acceleration",
};

const Pass change_end = {
    .name = "change end",
    .stage = STAGE_INTEGRATE,
    .cpu = &end_cpu,
    .shader = "change/end",
    .reads = "velocity acceleration",
    .writes = "acceleration",
};

static void run(const Substep *step, const Pass *pass)
{
    const PassInput input = {.dt = (float)step->dt};
    STAGE (step->clock, STAGE_INTEGRATE)
        step->backend->run(step->state, pass, &input);
}

static void begin(const Substep *step)
{
    run(step, &change_begin);
}

static void end(const Substep *step)
{
    run(step, &change_end);
}

static const Pass *const passes[] = {&change_begin, &change_end, NULL};

const Term term_change = {
    .name = "change",
    .words = "acceleration",
    .named = named,
    .needed = needed,
    .columns = change_columns,
    .passes = passes,
    .solve = -1,
    .begin = begin,
    .end = end,
    .unknown = &change_end,
};
