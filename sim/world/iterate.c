#include "sim/world/iterate.h"

#include <math.h>

static void measure(const Substep *step, const Iteration *iteration, StepSolve *solve)
{
    const Excess left = step->backend->excess(step->state, iteration->residual);
    solve->mean = left.mean;
    solve->most = left.greatest;
}

/* As often as it takes, with the excess asked for after each. */
static void iterate_here(const Substep *step, const Iteration *iteration, StepSolve *solve, double dt)
{
    *solve = (StepSolve){.tolerance = iteration->tolerance, .mean = INFINITY};
    if (iteration->begun)
        measure(step, iteration, solve);
    while (!(solve->mean <= iteration->tolerance) && solve->iterations < iteration->most) {
        for (int k = 0; iteration->passes[k]; k++)
            substep_run(step, iteration->passes[k], dt);
        solve->iterations++;
        measure(step, iteration, solve);
    }
    for (int k = 0; k < ITERATION_ASKED && iteration->asked[k].column; k++)
        *iteration->asked[k].to = step->backend->excess(step->state, iteration->asked[k].column);
}

void substep_iterate(const Substep *step, const Iteration *iteration, int which, double dt)
{
    const PassInput input = substep_input(step, dt);
    StepSolve *solve = &step->solves[which];
    if (step->backend->iterate)
        step->backend->iterate(step->state, iteration, &input, solve);
    else
        iterate_here(step, iteration, solve, dt);
    solve->failed = !(solve->mean <= STEP_SOLVE_STANDS * solve->tolerance);
}

/* Of so many iterations; what is beyond all classes is in the last one. */
static int class_of(uint64_t iterations)
{
    int shift = 0;
    while (iterations >> shift >= SOLVE_EXACT)
        shift++;
    const int octave = SOLVE_EXACT + (shift - 1) * SOLVE_OCTAVE;
    const int at = shift == 0 ? (int)iterations : octave + (int)(iterations >> (shift + 2)) - SOLVE_OCTAVE;
    return at < SOLVE_CLASSES ? at : SOLVE_CLASSES - 1;
}

/* The most iterations that are of a class. */
static uint64_t class_end(int at)
{
    const int octave = (at - SOLVE_EXACT) / SOLVE_OCTAVE, within = (at - SOLVE_EXACT) % SOLVE_OCTAVE;
    return at < SOLVE_EXACT ? (uint64_t)at : ((uint64_t)(SOLVE_OCTAVE + within + 1) << (octave + 3)) - 1;
}

void solve_tally_add(SolveTally *tally, const StepSolve solves[SOLVES_MAX])
{
    uint64_t iterations = 0;
    for (int k = 0; k < SOLVES_MAX; k++)
        iterations += (uint64_t)solves[k].iterations;
    tally->steps++;
    tally->iterations += iterations;
    tally->most_iterations = iterations > tally->most_iterations ? iterations : tally->most_iterations;
    tally->mean += solves[0].mean;
    tally->most = fmax(tally->most, solves[0].most);
    tally->classes[class_of(iterations)]++;
}

static uint64_t percentile_95(const SolveTally *tally)
{
    uint64_t below = 0;
    for (int k = 0; k < SOLVE_CLASSES - 1; k++)
        if (20 * (below += tally->classes[k]) >= 19 * tally->steps)
            return class_end(k) < tally->most_iterations ? class_end(k) : tally->most_iterations;
    return tally->most_iterations;
}

SolveFigures solve_tally_figures(const SolveTally *tally)
{
    const double steps = fmax((double)tally->steps, 1);
    return (SolveFigures){.steps = tally->steps,
                          .iterations_mean = (double)tally->iterations / steps,
                          .iterations_p95 = (double)percentile_95(tally),
                          .density_error_mean = tally->mean / steps,
                          .density_error_max = tally->most};
}
