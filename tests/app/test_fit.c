/* slosh fit against all settings of a small grid, for a dam break in the plane. Costs are particles times
   steps, independent of the machine's load. */
#include "tests/scratch.h"
#include "tests/sim/fixture.h"

#include "app/cli/cli.h"
#include "app/lab/fit.h"
#include "sim/gpu/gl.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

static Args args;
static FitPlan plan;
static FitSpace real;
static Error error;
static const Experiment experiment = {.table = &chart_table};
static ExperimentRun kept = {
    .of = &experiment, .args = &args, .file = {.table = &chart_table}, .rows = {.table = &chart_table}};
static int asked;

/* Particles times steps of a simulated second: all steps are fixed, "1.25 ms". */
static double cost_of(const FitFigures *figures)
{
    const ChartRow *row = chart_row(&plan.runs.used, figures->row);
    char *end;
    const double step_ms = strtod(row->step, &end);
    assert_string_equal(end, " ms");
    return isfinite(row->seconds) ? (double)row->particles * 1000 / step_ms : (double)NAN;
}

static bool run(void *of, const FitPoint *point, double predicted, FitFigures *figures)
{
    asked++;
    if (!real.run(of, point, predicted, figures))
        fail_msg("%s", plan.runs.error.message);
    figures->cost = cost_of(figures);
    return true;
}

enum { METHODS = 2, SPACINGS = 8, STEPS = 4, SUPPORTS = 2, ALL = METHODS * SPACINGS * STEPS * SUPPORTS };

/* The grid: two methods, spacings from 4 to 1 of the scene's, four steps, two supports. */
static void make_grid(FitSpace *space)
{
    fit_runs_space(&plan.runs, &real);
    *space = real;
    space->run = run;
    space->repeat = NULL;
    space->axis[FIT_METHOD].values = METHODS;
    space->axis[FIT_PRESET].values = 1;
    space->axis[FIT_SPACING].values = SPACINGS;
    space->axis[FIT_STEP].values = STEPS;
    space->axis[FIT_SUPPORT].values = SUPPORTS;
    for (int x = FIT_TERM; x < space->axes; x++)
        space->axis[x].values = 1;
}

static const FitTry *find(const FitPoint *point)
{
    for (int i = 0; i < plan.ladder.count; i++)
        if (plan.ladder.tries[i].fate != FIT_PRUNED &&
            memcmp(&plan.ladder.tries[i].point, point, sizeof *point) == 0)
            return &plan.ladder.tries[i];
    return NULL;
}

/* Of the whole grid, spacings beside each other, from coarse to fine; how many there are. */
static int run_all(const FitSpace *space, FitFigures all[ALL])
{
    int ran = 0;
    for (int i = 0; i < ALL; i++) {
        const int rest = i / SPACINGS;
        const FitPoint point = {
            {rest % METHODS, 0, i % SPACINGS, rest / METHODS % STEPS, rest / METHODS / STEPS}};
        const FitTry *try = find(&point);
        all[i].holds = false;
        if (try)
            all[i] = try->figures;
        else if (!space->exists(space->of, &point) || !space->run(space->of, &point, (double)NAN, &all[i]))
            continue;
        ran++;
    }
    return ran;
}

/* Within the bounds; of an error at the next finer spacing too, else luck brought it there. */
static bool is_within(const FitFigures all[ALL], int i)
{
    const bool luck = i % SPACINGS < SPACINGS - 1 && all[i + 1].holds && all[i + 1].error > plan.goal.error;
    return all[i].holds && all[i].error <= plan.goal.error && all[i].cost <= plan.goal.cost && !luck;
}

/* The least of all of the grid. */
static double exhaustive(const FitSpace *space, int *ran)
{
    static FitFigures all[ALL];
    double best = INFINITY;
    *ran = run_all(space, all);
    for (int i = 0; i < ALL; i++)
        if (is_within(all, i))
            best = fmin(best, isinf(plan.goal.cost) ? all[i].cost : all[i].error);
    return best;
}

static void start(const char *asked_for, const char *amount)
{
    static char scene[] = SLOSH_SOURCE_DIR "/scenes/dam_break_2d.yaml";
    char *words[] = {"slosh",
                     "fit",
                     scene,
                     (char *)asked_for,
                     (char *)amount,
                     "--set",
                     "particles.spacing=0.04",
                     "--time",
                     "0.15",
                     "--quiet",
                     "--threads",
                     "1"};
    args_free(&args);
    trials_free(&kept.rows);
    if (!args_parse(cli_commands, sizeof words / sizeof *words, words, &args, &error) ||
        !fit_plan_make(&args, "", &plan, &error) || !fit_runs_begin(&plan.axes, &kept, &plan.runs, &error))
        fail_msg("%s", error.message);
    if (!fit_runs_floor(&plan.runs) || !fit_runs_reference(&plan.runs))
        fail_msg("%s", plan.runs.error.message);
}

static void compare(const char *what, const char *amount, double cost)
{
    FitSpace space;
    int all;
    start(what, amount);
    if (cost > 0)
        plan.goal = (FitGoal){INFINITY, cost};
    make_grid(&space);
    asked = 0;
    assert_true(fit_search(&space, &plan.goal, &plan.ladder));
    const int ran = asked;
    const double best = exhaustive(&space, &all);
    assert_true(plan.ladder.best >= 0 && isfinite(best));
    const FitFigures *found = &plan.ladder.tries[plan.ladder.best].figures;
    const double ratio = (isinf(plan.goal.cost) ? found->cost : found->error) / best;
    print_message("%s %s: %.3f of the best of %d, by %d runs\n", what, amount, ratio, all, ran);
    assert_true(ratio <= 1.1);
    assert_true(ran < all);
}

static void the_cheapest(void **state)
{
    (void)state;
    compare("--error", "1", 0);
    compare("--error", "1.4", 0);
    compare("--error", "2", 0);
}

static void the_most_accurate(void **state)
{
    (void)state;
    compare("--frame-ms", "1", 1e5);
    compare("--frame-ms", "2", 3e5);
}

static int make_csv(void **state)
{
    char csv[SCRATCH_SIZE];
    (void)state;
    backends_add();
    scratch_file(csv, "");
    snprintf(kept.csv, sizeof kept.csv, "%s", csv);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_cheapest),
        cmocka_unit_test(the_most_accurate),
    };
    return cmocka_run_group_tests(tests, make_csv, NULL);
}
