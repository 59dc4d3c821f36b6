/* The search of `slosh fit` against all settings, over made-up costs and errors. */
#include "tests/sim/fixture.h"

#include "app/lab/fit.h"

#include <math.h>

enum { LINE, RUNG, STEP, TERM, AXES, RUNGS = 7, STEPS = 5 };

/* A made-up fluid. */
typedef struct Toy {
    double order;      /* of the error over the spacing */
    double ripple;     /* how far errors are off a power: not monotone */
    double step_error; /* what a longest step adds */
    double noise;      /* of costs: predictions miss */
    int broken;        /* settings in a hundred that do not hold */
    bool hard;         /* all but the shortest steps break */
    int seed;
    int asked, stop_at; /* runs; 0: never */
    double best;        /* best run within the goal; INFINITY: none yet */
    const FitGoal *goal;
    bool repeats_fail; /* results of the first repeated setting */
} Toy;

static unsigned mix(const Toy *toy, const FitPoint *point, unsigned salt)
{
    unsigned h = 2166136261u ^ (unsigned)toy->seed ^ salt * 977u;
    for (int x = 0; x < AXES; x++)
        h = (h ^ (unsigned)point->at[x]) * 16777619u;
    h ^= h >> 13;
    h *= 2654435761u;
    return h ^ h >> 16;
}

/* -1 to 1, the same for the same setting. */
static double random_of(const Toy *toy, const FitPoint *point, unsigned salt)
{
    return (double)(mix(toy, point, salt) % 20001) / 10000 - 1;
}

static const double spacing[RUNGS] = {4, 3, 2, 1.5, 1.25, 1, 0.75}, length[STEPS] = {0.5, 0.7, 1, 1.4, 2};

static double work(void *of, const FitPoint *point)
{
    (void)of;
    return pow(spacing[point->at[RUNG]], -4) / length[point->at[STEP]];
}

static FitFigures figures(Toy *toy, const FitPoint *point)
{
    static const double line_cost[] = {1, 3, 0.4}, line_error[] = {0.04, 0.01, 0.2};
    static const double term_cost[] = {1, 1.3, 0.9, 1.6}, term_error[] = {1, 0.6, 1.3, 0.5};
    const int line = point->at[LINE], term = point->at[TERM];
    const double error = line_error[line] * term_error[term] * pow(spacing[point->at[RUNG]], toy->order) +
                         toy->step_error * pow(length[point->at[STEP]], 2);
    return (FitFigures){.cost = line_cost[line] * term_cost[term] * work(toy, point) *
                                exp(toy->noise * random_of(toy, point, 1)),
                        .error = error * exp(toy->ripple * random_of(toy, point, 2)),
                        .holds = (int)(mix(toy, point, 3) % 100) >= toy->broken &&
                                 (!toy->hard || point->at[STEP] == 0)};
}

static bool exists(void *of, const FitPoint *point)
{
    (void)of;
    return point->at[LINE] != 2 || point->at[TERM] != 3;
}

/* True if the next coarser rung is within the goal: may be requested as confirmation. */
static bool confirms(Toy *toy, FitPoint point)
{
    if (point.at[RUNG]-- == 0)
        return false;
    const FitFigures coarser = figures(toy, &point);
    return coarser.holds && coarser.error <= toy->goal->error;
}

static bool run(void *of, const FitPoint *point, double predicted, FitFigures *found)
{
    Toy *toy = of;
    if (++toy->asked == toy->stop_at)
        return false;
    *found = figures(toy, point);
    if (toy->asked > 1 && isfinite(toy->goal->error) && toy->ripple == 0 && !confirms(toy, *point))
        assert_false(predicted > FIT_MARGIN * toy->best * (1 + 1e-9));
    if (toy->asked > 1 && isfinite(toy->goal->cost))
        assert_false(predicted > FIT_MARGIN * toy->goal->cost * (1 + 1e-9));
    if (found->holds && found->error <= toy->goal->error)
        toy->best = fmin(toy->best, found->cost);
    return true;
}

static FitSpace space_of(Toy *toy)
{
    return (FitSpace){.axes = AXES,
                      .axis = {[LINE] = {FIT_LINE, 3, 0},
                               [RUNG] = {FIT_LADDER, RUNGS, 5},
                               [STEP] = {FIT_ORDERED, STEPS, 2},
                               [TERM] = {FIT_FREE, 4, 0}},
                      .power = 4,
                      .exists = exists,
                      .work = work,
                      .run = run,
                      .of = toy};
}

/* Whether the next finer rung is too: else it is luck. */
static bool is_no_luck(Toy *toy, FitPoint point, const FitGoal *goal)
{
    if (isinf(goal->error) || ++point.at[RUNG] == RUNGS)
        return true;
    const FitFigures finer = figures(toy, &point);
    return !finer.holds || finer.error <= goal->error;
}

/* The least of all that are within; INFINITY: none is. */
static double exhaustive(Toy *toy, const FitGoal *goal)
{
    double best = INFINITY;
    for (int i = 0; i < 3 * RUNGS * STEPS * 4; i++) {
        const FitPoint point = {{i % 3, i / 3 % RUNGS, i / 3 / RUNGS % STEPS, i / 3 / RUNGS / STEPS}};
        const FitFigures all = figures(toy, &point);
        if (exists(toy, &point) && all.holds && all.error <= goal->error && all.cost <= goal->cost &&
            is_no_luck(toy, point, goal))
            best = fmin(best, isinf(goal->cost) ? all.cost : all.error);
    }
    return best;
}

static FitLadder ladder;

/* What was found, over the best there is. */
static double ratio(Toy *toy, const FitGoal *goal)
{
    const FitSpace space = space_of(toy);
    const double best = exhaustive(toy, goal);
    toy->asked = 0;
    toy->best = INFINITY;
    toy->goal = goal;
    assert_true(fit_search(&space, goal, &ladder));
    if (isinf(best)) {
        assert_int_equal(ladder.best, -1);
        return 1;
    }
    if (ladder.best < 0)
        return INFINITY;
    const FitFigures *found = &ladder.tries[ladder.best].figures;
    assert_true(found->holds && found->error <= goal->error && found->cost <= goal->cost);
    assert_true(is_no_luck(toy, ladder.tries[ladder.best].point, goal));
    return (isinf(goal->cost) ? found->cost : found->error) / best;
}

static void finds_what_exhaustive_search_finds(void **state)
{
    (void)state;
    double worst = 1;
    int asked = 0, searches = 0;
    for (int seed = 0; seed < 40; seed++)
        for (int k = 0; k < 6; k++) {
            Toy toy = {.order = 0.7 + 0.3 * (seed % 5),
                       .step_error = 0.002 * (seed % 3),
                       .noise = 0.03,
                       .seed = seed};
            const FitGoal goal =
                k % 2 ? (FitGoal){INFINITY, 0.02 * pow(6, k)} : (FitGoal){0.01 * pow(2.5, k), INFINITY};
            worst = fmax(worst, ratio(&toy, &goal));
            asked += toy.asked;
            searches++;
        }
    print_message("smooth: worst %.3f of the best, %d of 385 runs in the mean\n", worst, asked / searches);
    assert_true(worst <= 1.1 && asked / searches <= 36);
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void errors_that_do_not_fall(void **state)
{
    (void)state;
    enum { SEARCHES = 240 };
    static double off[SEARCHES];
    int asked = 0;
    for (int i = 0; i < SEARCHES; i++) {
        Toy toy = {.order = 0.7 + 0.3 * (i % 5),
                   .step_error = 0.002 * (i % 3),
                   .noise = 0.1,
                   .ripple = 0.5,
                   .broken = 10,
                   .seed = 1000 + i};
        const int k = i / 5 % 6;
        const FitGoal goal =
            k % 2 ? (FitGoal){INFINITY, 0.02 * pow(6, k)} : (FitGoal){0.01 * pow(2.5, k), INFINITY};
        off[i] = ratio(&toy, &goal);
        asked += toy.asked;
    }
    qsort(off, SEARCHES, sizeof *off, compare);
    print_message(
        "rippled: median %.3f, nine in ten %.3f, worst %.3f of the best, %d of 385 runs in the mean\n",
        off[SEARCHES / 2], off[SEARCHES * 9 / 10], off[SEARCHES - 1], asked / SEARCHES);
    assert_true(off[SEARCHES / 2] <= 1.1 && off[SEARCHES * 9 / 10] <= 2.3);
}

/* Without a setting within the goal none is chosen, and the nearest is reported. If no setting holds,
   there is no nearest. */
static void nothing_within(void **state)
{
    (void)state;
    Toy toy = {.order = 1};
    const FitGoal errors = {1e-4, INFINITY}, costs = {INFINITY, 1e-9};
    assert_true(ratio(&toy, &errors) == 1);
    const int nearest = fit_closest(&ladder, &errors);
    assert_true(nearest >= 0);
    for (int i = 0; i < ladder.count; i++)
        assert_false(ladder.tries[i].figures.error < ladder.tries[nearest].figures.error);
    assert_true(ratio(&toy, &costs) == 1);
    toy.broken = 100;
    assert_true(ratio(&toy, &errors) == 1);
    assert_int_equal(fit_closest(&ladder, &errors), -1);
}

/* Where each step but the shortest breaks a line is tried with that. */
static void steps_that_are_too_long(void **state)
{
    (void)state;
    Toy toy = {.order = 1, .hard = true};
    const FitGoal goal = {0.05, INFINITY};
    assert_true(ratio(&toy, &goal) <= 1.1);
    assert_true(ladder.best >= 0);
}

/* A search that was stopped anywhere has whole tries alone. */
static void stops_where_it_is_told(void **state)
{
    (void)state;
    const FitGoal goal = {0.05, INFINITY};
    Toy toy = {.order = 1, .ripple = 0.3, .seed = 5};
    ratio(&toy, &goal);
    const int all = toy.asked;
    for (toy.stop_at = 1; toy.stop_at <= all; toy.stop_at++) {
        const FitSpace space = space_of(&toy);
        toy.asked = 0;
        toy.best = INFINITY;
        assert_false(fit_search(&space, &goal, &ladder));
        int ran = 0;
        for (int i = 0; i < ladder.count; i++)
            ran += ladder.tries[i].fate != FIT_PRUNED;
        assert_int_equal(ran, toy.stop_at - 1);
        assert_int_equal(toy.asked, toy.stop_at);
    }
}

static bool repeat(void *of, const FitPoint *point, const FitFigures *found, double *worst, bool *holds)
{
    Toy *toy = of;
    (void)point;
    *worst = toy->repeats_fail ? 1 : 1.01 * found->error;
    *holds = true;
    toy->repeats_fail = false;
    return true;
}

/* What only luck brought within is left for the next best. */
static void a_repeat_that_is_beyond_counts(void **state)
{
    (void)state;
    const FitGoal goal = {0.05, INFINITY}, unbound = {INFINITY, INFINITY}; /* dearer ones may be run then */
    Toy toy = {.order = 1, .goal = &unbound};
    FitSpace space = space_of(&toy);
    space.repeat = repeat;
    assert_true(fit_search(&space, &goal, &ladder));
    const FitTry first = ladder.tries[ladder.best];
    assert_true(fabs(first.worst / first.figures.error - 1.01) < 1e-9);
    toy.repeats_fail = true;
    assert_true(fit_search(&space, &goal, &ladder));
    const FitTry second = ladder.tries[ladder.best];
    assert_true(second.figures.cost > first.figures.cost && second.figures.error <= goal.error);
    int left = 0;
    for (int i = 0; i < ladder.count; i++)
        left += ladder.tries[i].fate == FIT_REPEAT;
    assert_int_equal(left, 1);
}

/* What repeats scatter by is no gain: of settings as accurate as far as can be told the cheapest. */
static void scatter_is_no_gain(void **state)
{
    (void)state;
    const FitGoal goal = {INFINITY, 2};
    Toy toy = {.order = 1, .step_error = 0.001, .goal = &goal};
    FitSpace space = space_of(&toy);
    assert_true(fit_search(&space, &goal, &ladder));
    const FitFigures most = ladder.tries[ladder.best].figures;
    space.scatter = 0.3 * most.error;
    assert_true(fit_search(&space, &goal, &ladder));
    const FitFigures found = ladder.tries[ladder.best].figures;
    assert_true(found.cost < most.cost && found.error <= most.error + space.scatter);
    for (int i = 0; i < ladder.count; i++)
        if (ladder.tries[i].fate == FIT_WITHIN && ladder.tries[i].figures.error <= most.error + space.scatter)
            assert_true(ladder.tries[i].figures.cost >= found.cost);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_what_exhaustive_search_finds),
        cmocka_unit_test(errors_that_do_not_fall),
        cmocka_unit_test(nothing_within),
        cmocka_unit_test(steps_that_are_too_long),
        cmocka_unit_test(stops_where_it_is_told),
        cmocka_unit_test(a_repeat_that_is_beyond_counts),
        cmocka_unit_test(scatter_is_no_gain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
