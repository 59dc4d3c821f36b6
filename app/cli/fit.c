#include "app/lab/fit.h"
#include "app/base/file.h"
#include "app/base/output.h"
#include "app/base/program.h"
#include "app/bench/bench.h"
#include "app/cli/cli_private.h"
#include "app/run/offscreen.h"

#include <math.h>
#include <string.h>

static bool check_outputs(const FitPlan *plan, Error *error)
{
    const char *json = plan->args->json;
    return fit_scene_check(plan->output, error) && output_check(plan->csv, error) &&
           (!json || json_file_check(json, error));
}

/* An error below the scatter of repeated runs would be decided by chance. */
static bool check_floor(const FitPlan *plan, Error *error)
{
    const double floor = plan->runs.floor;
    if (!isfinite(floor))
        fputs("the scene as it is breaks: how far repeats of it scatter is not known\n", stderr);
    return !(plan->goal.error < floor) ||
           error_set(
               error,
               "--error %g: it cannot be told which settings are within it; three runs of the scene that "
               "differ by a millionth of a spacing are %.3g %% apart; ask for more than that",
               100 * plan->goal.error, 100 * floor);
}

/* No setting meets the goal: reports the nearest. */
static bool say_nearest(const FitPlan *plan, Error *error)
{
    char goal[96];
    const int nearest = fit_closest(&plan->ladder, &plan->goal);
    fit_goal_text(plan, goal, sizeof goal);
    if (nearest < 0)
        return error_set(error, "no setting that was tried holds: no error is known; use a smaller step");
    const ChartRow *row = fit_plan_row(plan, nearest);
    return error_set(
        error,
        "no setting that was tried is %s; the nearest is %s, %s, spacing %.4g m%s%s: error %.3g %% at "
        "%.3g s a simulated second",
        goal, row->method, row->step, row->spacing, *row->swept ? ", " : "", row->swept, 100 * row->error,
        row->seconds);
}

static void say_best(const FitPlan *plan)
{
    const FitTry *best = &plan->ladder.tries[plan->ladder.best], *own = fit_plan_own(plan);
    char goal[96];
    fit_goal_text(plan, goal, sizeof goal);
    printf("%s, the %s found %s on %s: error %.3g %% at %.3g s a simulated second, %.3g ms a frame of 1/30 s",
           plan->output, isinf(plan->goal.cost) ? "cheapest" : "most accurate", goal, bench_processor(),
           100 * best->figures.error, best->figures.cost, 1000 * FIT_FRAME * best->figures.cost);
    if (own == best)
        printf("; it is the scene as it is");
    else if (own && isfinite(own->figures.cost))
        printf("; the scene as it is has %.3g %% at %.3g s, %.3g times as much", 100 * own->figures.error,
               own->figures.cost, own->figures.cost / best->figures.cost);
    putchar('\n');
}

static bool search(FitPlan *plan, Error *error)
{
    FitSpace space;
    FitRuns *runs = &plan->runs;
    bool ok = fit_runs_floor(runs) && check_floor(plan, error) && fit_runs_reference(runs);
    fit_runs_space(runs, &space);
    ok = ok && fit_search(&space, &plan->goal, &plan->ladder);
    if (!ok) {
        *error = *runs->error.message ? runs->error : *error;
        return false;
    }
    if (!plan->args->quiet && runs->there > 0)
        fprintf(stderr, "%d of %d runs were in %s already\n", runs->there, runs->there + runs->made,
                plan->csv);
    if (!plan->args->quiet)
        fit_print(plan, stdout);
    return plan->ladder.best >= 0 || say_nearest(plan, error);
}

/* Makes a context; NULL if not needed. */
static bool make_context(const FitPlan *plan, Headless **context, Error *error)
{
    if (!world_on_gpu(&plan->scene.world))
        return true;
    *context = headless_create(plan->args->gpu, error);
    if (*context)
        fprintf(stderr, "renderer: %s\n", headless_renderer(*context));
    return *context != NULL;
}

static int fit(FitPlan *plan, Error *error)
{
    Headless *context = NULL;
    Error no_json = {{0}};
    notes_print(&plan->notes, stderr);
    const bool ready = check_outputs(plan, error) &&
                       fit_runs_begin(&plan->axes, plan->csv, plan->args->quiet, &plan->runs, error);
    bool ok = ready && make_context(plan, &context, error) && search(plan, error);
    headless_destroy(context);
    if (interrupted()) {
        fprintf(stderr, "stopped after %d runs; the same command goes on\n",
                plan->runs.there + plan->runs.made);
        return EXIT_INTERRUPTED;
    }
    ok = ok && fit_scene_write(plan, error);
    if (!ok)
        fprintf(stderr, "%s\n", error->message);
    else if (!plan->args->quiet)
        say_best(plan);
    if (!plan->args->json)
        return ok ? 0 : EXIT_FAILED;
    if (!ready || plan->ladder.count == 0) {
        if (json_file_check(plan->args->json, &no_json))
            failure_json_write(failure_json("fit", "scene", plan->args->scenes[0], plan->output, error),
                               plan->args->json);
    } else if (!fit_write_json(plan, ok ? NULL : error->message, plan->args->json, &no_json)) {
        fprintf(stderr, "%s\n", no_json.message);
        ok = false;
    }
    return ok ? 0 : EXIT_FAILED;
}

int cmd_fit(const Args *args)
{
    static FitPlan plan;
    Error error = {{0}};
    interrupt_install();
    if (fit_plan_make(args, &plan, &error))
        return fit(&plan, &error);
    fprintf(stderr, "%s\n", error.message);
    return EXIT_USAGE;
}
