#include "app/outcome/fluid_watch.h"

#include "app/outcome/outcome_watch.h"
#include "sim/kernel/kernel.h"
#include "sim/world/method.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Particles form pairs with the cubic kernel, and hardly with other selectable kernels. */
static const char *advice_on_clumps(const WorldDef *def)
{
    const char *kernel = method_kernels(def).slope->name;
    const bool chosen = !method_find(def->method)->incompressible && shape_kernel_find(kernel);
    if (!chosen)
        return "; use a particles.support of 2.5 or less, or shorter steps";
    return strcmp(kernel, "cubic") == 0
               ? "; use solver.kernel wendland_c2 with a particles.support of 3 or more, or a support of 2.5 or less"
               : "; use a larger particles.support, or solver.shifting 0.2";
}

static const char *advice(OutcomeKind kind, const WorldDef *def)
{
    const bool solves = method_find(def->method)->incompressible;
    switch (kind) {
    case OUTCOME_BOILS:
        return "; use a greater viscosity, or shorter steps";
    case OUTCOME_NOISY:
        return "; use shorter steps";
    case OUTCOME_FAST:
        return "; use a higher solver.sound_speed";
    case OUTCOME_SQUEEZED:
        return solves ? "; use more solver.iterations or shorter steps" : "; use a higher solver.sound_speed";
    case OUTCOME_CLUMPS:
        return advice_on_clumps(def);
    case OUTCOME_LEAKS:
        return "; use shorter steps, or solids that are thicker than twice the spacing";
    case OUTCOME_DIVERGES:
        return "; use shorter steps, or more of the solver's iterations (solver.iterations, "
               "solver.viscosity_iterations)";
    default:
        return "";
    }
}

/* Close particles at the start, such as emitted fluid or a jittered lattice, are no clumps; nothing else
   counts as normal. */
static void begin(FluidWatch *watch, const OutcomeLook *first)
{
    watch->looked = true;
    watch->start = (OutcomeLook){.time = first->time,
                                 .count = first->count,
                                 .close = watch->resumed ? 0 : first->close,
                                 .energy = (double)NAN,
                                 .scale = (double)NAN};
}

static void judge(const FluidWatch *watch, const OutcomeLook *now, Outcome *outcome)
{
    const OutcomeHistory history = {.count = 2, .look = {watch->start, *now}};
    outcome_judge(&history, outcome);
}

/* Removes reported failures from a look, so that they do not hide other kinds. */
static OutcomeLook untold(const FluidWatch *watch, OutcomeLook look)
{
    if (watch->told >> OUTCOME_NOISY & 1)
        look.energy = (double)NAN;
    if (watch->told >> OUTCOME_BOILS & 1)
        look.jump = 0;
    if (watch->told >> OUTCOME_FAST & 1)
        look.fastest = 0;
    if (watch->told >> OUTCOME_SQUEEZED & 1)
        look.pressed = 0;
    if (watch->told >> OUTCOME_CLUMPS & 1)
        look.close = 0;
    if (watch->told >> OUTCOME_LEAKS & 1)
        look.beyond = look.lost = 0;
    if (watch->told >> OUTCOME_DIVERGES & 1)
        look.stuck = false;
    return look;
}

bool fluid_watch(FluidWatch *watch, const WorldDef *def, World *world, char words[FLUID_WATCH_WORDS])
{
    WorldInfo info;
    OutcomeLook look;
    Outcome now;
    world_info(world, &info);
    const OutcomeLook known = outcome_of_info(def, &info);
    const bool fast = known.sound > 0 && known.fastest > known.sound && !(watch->told >> OUTCOME_FAST & 1);
    if (info.within_frame || (info.step < watch->next && !fast))
        return false;
    watch->next = info.step + (info.step < FLUID_WATCH_STEPS   ? FLUID_WATCH_STEPS
                               : info.step < FLUID_WATCH_LATER ? info.step
                                                               : FLUID_WATCH_LATER);
    if (world_on_gpu(def)) /* without waiting for the GPU */
        look = known;
    else if (!outcome_glance(&look, def, !watch->closed, world))
        return false; /* memory is short: retry at the next look */
    else if (!watch->looked)
        begin(watch, &look);
    judge(watch, &look, &now);
    if (now.kind > watch->worst.kind)
        watch->worst = now;
    watch->start.energy = fmin(watch->start.energy, look.energy); /* fmin skips NaN */
    look = untold(watch, look);
    judge(watch, &look, &now);
    if (now.kind <= OUTCOME_HOLDS)
        return false;
    watch->told |= 1u << now.kind;
    snprintf(words, FLUID_WATCH_WORDS, "t = %.4g s: %s: %s%s", now.time, outcome_word(now.kind), now.words,
             advice(now.kind, def));
    return true;
}

bool fluid_watch_outcome(const FluidWatch *watch, const WorldTrouble *trouble, Outcome *outcome)
{
    const OutcomeHistory end = {.trouble = *trouble};
    if (trouble->ended)
        outcome_judge(&end, outcome);
    else
        *outcome = watch->worst;
    return trouble->ended || watch->looked || watch->worst.kind > OUTCOME_HOLDS;
}
