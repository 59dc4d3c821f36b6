#include "app/lab/fit.h"
#include "app/base/file.h"
#include "app/base/program.h"
#include "app/bench/bench.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/run/offscreen.h"

#include <math.h>
#include <string.h>

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
                runs->run->csv);
    if (!plan->args->quiet)
        fit_print(plan, stdout);
    return plan->ladder.best >= 0 || say_nearest(plan, error);
}

static bool fit_plan(ExperimentRun *run, Error *error)
{
    FitPlan *plan = run->state;
    const bool ok = fit_name_files(run->args, run->output, run->csv, error) &&
                    fit_plan_make(run->args, run->output, plan, error);
    if (ok)
        notes_print(&plan->notes, stderr);
    return ok;
}

static bool fit_check(ExperimentRun *run, Error *error)
{
    return fit_scene_check(run->output, error);
}

static bool fit_run(ExperimentRun *run, Error *error)
{
    FitPlan *plan = run->state;
    const bool ok = fit_runs_begin(&plan->axes, run, &plan->runs, error) &&
                    (!world_on_gpu(&plan->scene.world) || experiment_context(run, error)) &&
                    search(plan, error);
    run->there = plan->runs.there + plan->runs.made;
    run->has_figures = plan->ladder.count > 0;
    return ok;
}

static bool fit_report(ExperimentRun *run, Error *error)
{
    const FitPlan *plan = run->state;
    if (!fit_scene_write(plan, error))
        return false;
    if (!run->args->quiet)
        say_best(plan);
    return true;
}

static json_t *fit_figures(const ExperimentRun *run, const char *failure)
{
    return fit_json(run->state, failure);
}

static const Experiment experiment = {
    .table = &chart_table,
    .size = sizeof(FitPlan),
    .plan = fit_plan,
    .check = fit_check,
    .run = fit_run,
    .report = fit_report,
    .json = fit_figures,
};

/* Without -o the outputs have names of their own. */
static void files_unnamed(CommandFiles *files, const Args *args)
{
    char output[1024];
    if (args->output)
        return;
    fit_default_output(args->scenes[0], output);
    command_files_add(files, FILE_REPLACED, "the scene of slosh fit,", output, NULL);
    command_files_add_beside(files, "the table of slosh fit,", output, strlen(".yaml"), ".csv", NULL);
}

static int run_command(const Args *args)
{
    return experiment_run(&experiment, args);
}

/* clang-format off */
static const OptionRow options[] = {
    {"--error", "PERCENT", OPTION_NUMBER, .offset = offsetof(FitOptions, error), .max = 1000, .flags = OPTION_OWN | OPTION_OPEN_LOW, .help = "the cheapest settings within that error against the scene's finest run, or the case's reference; more than 0: a run without error is the reference itself"},
    {"--frame-ms", "MS", OPTION_NUMBER, .offset = offsetof(FitOptions, frame_ms), .max = 1e6, .flags = OPTION_OWN | OPTION_OPEN_LOW, .help = "the most accurate settings that compute a frame, 1/30 s, in so many ms in the mean, and no slower than real time"},
    ROW_OUTPUT("OUT", .files = files_chart, .help = "the scene with these settings, OUT.yaml (NAME_fit.yaml); its runs in OUT.csv, which a later run goes on with"),
    ROW_TIME(0, "simulated seconds of a scene (2); a case has its own"),
    ROWS_SCENE, ROWS_PROCESSOR, ROW_GPU, ROW_SHADERS, ROW_DEVICE_REFUSED("what is compared moves as the scene says, and no other way"),
    ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_fit = {
    .name = "fit",
    .usage = "SCENE|CASE --error PERCENT|--frame-ms MS ...",
    .help = "the cheapest settings within an error, or with --frame-ms the most accurate in real time",
    .takes = "scene or case",
    .takes_min = 1,
    .takes_max = 1,
    .own_size = sizeof(FitOptions),
    .argument_files = files_scene,
    .unnamed_files = files_unnamed,
    .options = options,
    .run = run_command,
};
