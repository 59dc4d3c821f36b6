#include "sim/step/substep.h"

#include "shaders/sim/step/coarse_rule.h"

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

static void measure(const Substep *step, const Iteration *iteration, double scale, IterationFound *found)
{
    const Excess left = step->backend->excess(step->state, iteration->residual);
    found->mean = scale * left.mean;
    found->most = scale * left.greatest;
}

/* 1 / (unit of the residual); 1 if the mean is 0, with residual 0. */
static double scale_of(const Substep *step, const Iteration *iteration)
{
    const double mean = iteration->scale ? step->backend->excess(step->state, iteration->scale).mean : 1;
    return mean == 0 ? 1 : 1 / mean;
}

/* Same rule as decide.comp in shaders/sim/compute. */
static bool goes_on(const Iteration *iteration, const IterationFound *found)
{
    return found->iterations < iteration->most &&
           (!(found->mean <= iteration->tolerance) ||
            (found->most > iteration->worst && found->iterations < iteration->few));
}

/* Mean residuals of an iteration and the two before. */
typedef struct Progress {
    double mean[3];
} Progress;

/* Same rule as decide_coarse of decide.comp. The test is squared: without libm, whose last bit may differ
   between the processors of ranks. */
static bool is_slow(const Iteration *iteration, const IterationFound *found, Progress *progress)
{
    double *mean = progress->mean;
    mean[0] = mean[1], mean[1] = mean[2], mean[2] = found->mean;
    if (!iteration->coarse || (int)found->iterations % COARSE_EVERY != COARSE_AFTER)
        return false;
    const double part2 = mean[2] / mean[0], tolerance = iteration->tolerance;
    double left2 = mean[2] * mean[2];
    for (int k = 0; k < COARSE_WORTH; k++)
        left2 *= part2;
    return left2 > tolerance * tolerance;
}

static Excess excess_of(const Substep *step, const ColumnDef *column)
{
    return column ? step->backend->excess(step->state, column) : (Excess){0};
}

/* Iterates with a query of the excess after each iteration. */
static void iterate_here(const Substep *step, const Iteration *iteration, double dt, IterationFound *found)
{
    const double scale = scale_of(step, iteration);
    PassInput input = substep_input(step, dt);
    Conjugate now = {0};
    Progress progress = {0};
    *found = (IterationFound){.mean = INFINITY};
    if (iteration->begun)
        measure(step, iteration, scale, found);
    while (goes_on(iteration, found)) {
        conjugate(step, iteration, &now);
        input.go = (float)now.go;
        input.turn = (float)now.turn;
        input.corrected = is_slow(iteration, found, &progress);
        if (input.corrected)
            step->backend->run(step->state, iteration->coarse, &input);
        for (int k = 0; iteration->passes[k]; k++)
            step->backend->run(step->state, iteration->passes[k], &input);
        found->iterations++;
        measure(step, iteration, scale, found);
    }
    found->way = excess_of(step, iteration->way);
    found->left = excess_of(step, iteration->left);
}

/* True if `renew` is due after the iterations; same rule as renew.comp. */
static bool strays(const Iteration *iteration, const IterationFound *found)
{
    return iteration->way && !(found->way.mean <= iteration->way_most) && found->iterations < iteration->most;
}

void iteration_report(const Iteration *iteration, const IterationFound *found, StepSolve *solve)
{
    const double unit = iteration->unit > 0 ? iteration->unit : 1, allowed = iteration->allowed;
    *solve = (StepSolve){.iterations = found->iterations,
                         .mean = found->mean / unit,
                         .most = found->most / unit,
                         .tolerance = fmax(allowed, 0)};
    solve->failed = allowed >= 0 && !(solve->mean <= STEP_SOLVE_STANDS * allowed);
    if (!iteration->left || solve->failed)
        return;
    solve->mean = found->left.mean;
    solve->most = found->left.greatest;
}

void substep_iterate(const Substep *step, const Iteration *iteration, int which, double dt)
{
    const PassInput input = substep_input(step, dt);
    StepSolve *solve = &step->solves[which];
    Iteration round = *iteration;
    IterationFound found;
    double done = 0;
    if (step->backend->iterate) {
        if (step->backend->iterate(step, iteration, which, &input, &found))
            iteration_report(iteration, &found, solve);
        return;
    }
    for (int renewed = 0;; renewed++) {
        iterate_here(step, &round, dt, &found);
        done += found.iterations;
        if (!strays(&round, &found) || renewed == iteration->renewals)
            break;
        round.most -= (int)found.iterations;
        round.begun = true;
        iteration->renew(step);
    }
    found.iterations = done;
    iteration_report(iteration, &found, solve);
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
