/* after: J. J. Monaghan, "Simulating free surface flows with SPH", 1994 */
#include "sim/world/method.h"

/* Leapfrog as the symmetric composition drift, continuity, kick, continuity, drift (halves but for the kick):
   each part is exact by itself where the others hold still, so that the whole is of second order, runs
   backwards as forwards but for viscosity, and needs one grid a step. */
static void wcsph_substep(const Substep *step)
{
    const Backend *b = step->backend;
    void *state = step->state;
    const float half = 0.5F * (float)step->dt;

    STAGE (step->clock, STAGE_INTEGRATE)
        b->drift(state, &step->first_half);
    STAGE (step->clock, STAGE_GRID)
        b->grid(state);
    STAGE (step->clock, STAGE_DENSITY)
        b->continuity(state, half);
    STAGE (step->clock, STAGE_FORCE)
        b->force(state, &step->apparent);
    STAGE (step->clock, STAGE_INTEGRATE)
        substep_kick(step);
    STAGE (step->clock, STAGE_DENSITY)
        b->continuity(state, half);
    if (step->shifts)
        STAGE (step->clock, STAGE_FORCE)
            b->shift(state, (float)step->dt);
    STAGE (step->clock, STAGE_INTEGRATE)
        b->drift(state, &step->second_half);
}

const Method method_wcsph = {
    .name = "wcsph",
    .help = "Monaghan 1994: density by continuity, Tait's equation of state; leapfrog",
    .substep = wcsph_substep,
};
