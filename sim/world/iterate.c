#include "sim/world/iterate.h"

void substep_iterate(const Substep *step, const Iteration *iteration, int which, double dt)
{
    StepSolve *solve = &step->solves[which];
    *solve = (StepSolve){.tolerance = iteration->tolerance};
    do {
        for (int k = 0; iteration->passes[k]; k++)
            substep_run(step, iteration->passes[k], dt);
        const Excess left = step->backend->excess(step->state, iteration->residual);
        solve->iterations++;
        solve->mean = left.mean;
        solve->most = left.greatest;
    } while (!(solve->mean <= iteration->tolerance) && solve->iterations < iteration->most);
}

bool step_solve_failed(const StepSolve *solve)
{
    return solve->iterations > 0 && !(solve->mean <= STEP_SOLVE_STANDS * solve->tolerance);
}
