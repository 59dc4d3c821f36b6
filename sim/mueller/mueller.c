/* after: M. Müller, D. Charypar, M. Gross, "Particle-based fluid simulation for interactive applications",
 * 2003 */
#include "sim/world/method.h"

/* Symplectic Euler with the drift in two halves around the kick (position Verlet): the same single evaluation
   of the forces and the same stability, but second order, and exact for free flight under gravity. */
static void mueller_substep(const Substep *step)
{
    const Backend *b = step->backend;
    void *state = step->state;

    STAGE (step->clock, STAGE_INTEGRATE)
        b->drift(state, &step->first_half);
    STAGE (step->clock, STAGE_GRID)
        b->grid(state);
    STAGE (step->clock, STAGE_DENSITY)
        b->density(state);
    STAGE (step->clock, STAGE_FORCE)
        b->force(state, &step->apparent);
    STAGE (step->clock, STAGE_INTEGRATE) {
        substep_kick(step);
        b->drift(state, &step->second_half);
    }
}

const Method method_mueller = {
    .name = "mueller",
    .help = "Müller 2003: density by summation, p = c^2 (rho - rho0); symplectic Euler",
    .substep = mueller_substep,
};
