#include "sim/step/substep.h"

#include <math.h>

/* State of conjugate gradients. */
typedef struct Conjugate {
    double power, go, turn;
} Conjugate;

/* The next step and direction: Chronopoulos and Gear 1989, eq. 2.2. */
static void conjugate(const Substep *step, const Iteration *iteration, Conjugate *now)
{
    if (!iteration->power)
        return;
    const Backend *b = step->backend;
    const double power = b->sum(step->state, iteration->power),
                 curvature = b->sum(step->state, iteration->curvature);
    now->turn = now->power != 0 ? power / now->power : 0;
    const double bent = curvature - (now->turn != 0 && now->go != 0 ? now->turn * power / now->go : 0);
    now->go = bent > 0 ? power / bent : 0;
    now->power = power;
}

static void measure(const Substep *step, const Iteration *iteration, double scale, StepSolve *solve)
{
    const Excess left = step->backend->excess(step->state, iteration->residual);
    solve->mean = scale * left.mean;
    solve->most = scale * left.greatest;
}

/* 1 / (unit of the residual); 1 if the mean is 0, with residual 0. */
static double scale_of(const Substep *step, const Iteration *iteration)
{
    const double mean = iteration->scale ? step->backend->excess(step->state, iteration->scale).mean : 1;
    return mean == 0 ? 1 : 1 / mean;
}

/* Same rule as decide.comp in shaders/sim/compute. */
static bool goes_on(const Iteration *iteration, const StepSolve *solve)
{
    return solve->iterations < iteration->most &&
           (!(solve->mean <= iteration->tolerance) ||
            (solve->most > iteration->worst && solve->iterations < iteration->few));
}

/* Iterates with a query of the excess after each iteration. */
static void iterate_here(const Substep *step, const Iteration *iteration, StepSolve *solve, double dt)
{
    const double scale = scale_of(step, iteration);
    PassInput input = substep_input(step, dt);
    Conjugate now = {0};
    *solve = (StepSolve){.tolerance = iteration->tolerance, .mean = INFINITY};
    if (iteration->begun)
        measure(step, iteration, scale, solve);
    while (goes_on(iteration, solve)) {
        conjugate(step, iteration, &now);
        input.go = (float)now.go;
        input.turn = (float)now.turn;
        for (int k = 0; iteration->passes[k]; k++)
            step->backend->run(step->state, iteration->passes[k], &input);
        solve->iterations++;
        measure(step, iteration, scale, solve);
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

/* Class of a number of iterations; the last class takes all larger numbers. */
static int class_of(uint64_t iterations)
{
    int shift = 0;
    while (iterations >> shift >= SOLVE_EXACT)
        shift++;
    const int octave = SOLVE_EXACT + (shift - 1) * SOLVE_OCTAVE;
    const int at = shift == 0 ? (int)iterations : octave + (int)(iterations >> (shift + 2)) - SOLVE_OCTAVE;
    return at < SOLVE_CLASSES ? at : SOLVE_CLASSES - 1;
}

/* The largest number of iterations in a class. */
static uint64_t class_end(int at)
{
    const int octave = (at - SOLVE_EXACT) / SOLVE_OCTAVE, within = (at - SOLVE_EXACT) % SOLVE_OCTAVE;
    return at < SOLVE_EXACT ? (uint64_t)at : ((uint64_t)(SOLVE_OCTAVE + within + 1) << (octave + 3)) - 1;
}

void solve_tally_add(SolveTally *tally, const StepSolve solves[SOLVES_MAX])
{
    uint64_t iterations = 0;
    for (int k = 0; k < SOLVES_OF_METHOD; k++)
        iterations += (uint64_t)solves[k].iterations;
    tally->steps++;
    tally->iterations += iterations;
    tally->most_iterations = iterations > tally->most_iterations ? iterations : tally->most_iterations;
    tally->mean += solves[0].mean;
    tally->most = fmax(tally->most, solves[0].most);
    tally->rubbed += solves[SOLVE_VISCOSITY].iterations;
    tally->left += solves[SOLVE_VISCOSITY].mean;
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
                          .density_error_max = tally->most,
                          .viscosity_iterations_mean = tally->rubbed / steps,
                          .viscosity_residual_mean = tally->left / steps};
}
