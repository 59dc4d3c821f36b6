#include "app/outcome/fluid_watch.h"

#include "app/outcome/outcome_watch.h"
#include "sim/world/method.h"

#include <stdio.h>

static const char *advice(OutcomeKind kind, const WorldDef *def)
{
    const bool solves = method_find(def->method)->incompressible;
    switch (kind) {
    case OUTCOME_SQUEEZED:
        return solves ? "; use more solver.iterations or shorter steps" : "; use a higher solver.sound_speed";
    case OUTCOME_CLUMPS:
        return "; use solver.kernel wendland_c2 with a particles.support of 3 or more, or a support of 2.5 or less";
    case OUTCOME_LEAKS:
        return "; use shorter steps, or solids that are thicker than twice the spacing";
    default:
        return "";
    }
}

/* Of a history of two looks: what it began with, and what it is now. */
static bool look(FluidWatch *watch, const WorldDef *def, World *world)
{
    OutcomeHistory *history = &watch->history;
    const int at = history->count > 0;
    if (!outcome_glance(&history->look[at], def, world))
        return false; /* no memory: the next look may have it */
    history->count = at + 1;
    return true;
}

bool fluid_watch(FluidWatch *watch, const WorldDef *def, World *world, char words[FLUID_WATCH_WORDS])
{
    WorldInfo info;
    Outcome now;
    world_info(world, &info);
    if (world_on_gpu(def) || info.within_frame || info.step < watch->next)
        return false;
    watch->next = info.step + FLUID_WATCH_STEPS;
    if (!look(watch, def, world))
        return false;
    outcome_judge(&watch->history, &now);
    if (now.kind > watch->worst.kind)
        watch->worst = now;
    if (now.kind <= OUTCOME_HOLDS || watch->told >> now.kind & 1)
        return false;
    watch->told |= 1u << now.kind;
    snprintf(words, FLUID_WATCH_WORDS, "t = %.4g s: %s%s", now.time, now.words, advice(now.kind, def));
    return true;
}

bool fluid_watch_outcome(const FluidWatch *watch, const WorldTrouble *trouble, Outcome *outcome)
{
    const OutcomeHistory end = {.trouble = *trouble};
    if (trouble->ended)
        outcome_judge(&end, outcome);
    else
        *outcome = watch->worst;
    return trouble->ended || watch->history.count > 0;
}
