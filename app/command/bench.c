#include "app/lab/bench.h"
#include "app/base/file.h"
#include "app/base/output.h"
#include "app/base/program.h"
#include "app/command/bench_ablate.h"
#include "app/command/bench_micro.h"
#include "app/command/bench_plan.h"
#include "app/command/bench_points.h"
#include "app/command/cmd.h"
#include "app/input/device/devices.h"
#include "app/input/mapping.h"
#include "app/lab/chart.h"
#include "app/meter/report.h"
#include "app/play/play.h"

#include <stdlib.h>
#include <string.h>

enum { DEFAULT_FRAMES = 200, TABLE_FRAMES = 40 };

static GlClock clock_of(ClockChoice choice)
{
    return choice == CLOCK_CHOICE_GL       ? GL_CLOCK_QUERY
           : choice == CLOCK_CHOICE_FINISH ? GL_CLOCK_FINISH
                                           : GL_CLOCK_AUTO;
}

/* Checks --device: a playable recording, and its mapping. */
static bool device_check(const Args *args, Error *error)
{
    Mapping mapping;
    if (args->device && args->play)
        return error_set(error,
                         "slosh bench: with --play a script shakes the box; leave --device out, or --play");
    return !args->device ||
           (devices_check(args->device, error) && mapping_load(args->mapping, &mapping, error));
}

/* Reads all cases before the first run: a mistake in the last case shows at once. */
static bool cases_check(const Plan *plan, bool *context, Error *error)
{
    *context = false;
    for (size_t i = 0; i < plan_cases(plan); i++) {
        Scene scene;
        if (!plan_case_load(plan, i, false, &scene, error) || !world_can(&scene.world, error))
            return false;
        *context |= world_on_gpu(&scene.world) || strcmp(scene.view.kind, "none") != 0;
    }
    return true;
}

/* Counts of measured and of failed cases. */
typedef struct Tally {
    size_t done, measured;
    size_t fluids; /* blew up, leaked or did not converge: a valid row of a sweep */
    size_t others; /* failed for a different reason */
} Tally;

/* Reports a failure at once, even if quiet; the following cases still run. */
static void tell_failure(const BenchResult *result, Tally *tally)
{
    fprintf(stderr, "%s%s%s\n", result->swept, result->swept[0] ? ": " : "", result->failure.message);
    tally->fluids += result->outcome.kind != OUTCOME_NONE;
    tally->others += result->outcome.kind == OUTCOME_NONE;
}

static bool measure_one(const Plan *plan, size_t at, Headless *context, BenchResult *result, Error *error)
{
    const Args *args = plan->args;
    const double part = 1 / (double)plan_cases(plan);
    Scene scene;
    Progress progress;
    char swept[256];
    if (!plan_case_load(plan, at, true, &scene, error))
        return false;
    plan_case_name(plan, at, swept, sizeof swept);
    const BenchSetup setup = {
        .scene = &scene,
        .swept = swept,
        .context = context,
        .draws = strcmp(scene.view.kind, "none") != 0,
        .width = args->width,
        .height = args->height,
        .frames = args->frames  ? args->frames
                  : plan->table ? TABLE_FRAMES
                                : DEFAULT_FRAMES,
        .seconds = plan->table ? plan->table->seconds : 0,
        .from = args->time_given ? args->time : 0,
        .clock = clock_of(args->clock),
        .device = args->device,
        .mapping = args->mapping,
    };
    progress_begin(&progress, stderr, "bench", args->quiet);
    bench_measure(&setup, &progress, (double)at * part, part, result);
    progress_end(&progress);
    return true;
}

static bool measure_all(const Plan *plan, Headless *context, BenchResult *results, Tally *tally, Error *error)
{
    while (tally->done < plan_cases(plan) && !interrupted()) {
        BenchResult *result = &results[tally->done];
        if (!measure_one(plan, tally->done, context, result, error))
            return false;
        if (interrupted() && *result->failure.message) {
            *error = result->failure;
            return false;
        }
        tally->done++;
        if (*result->failure.message)
            tell_failure(result, tally);
        else
            tally->measured++;
        if (!plan->args->quiet && !plan->table)
            bench_print(result, stdout);
    }
    return true;
}

static int fail(const Error *error, int code)
{
    fprintf(stderr, "%s\n", error->message);
    return code;
}

static bool show_table(const Plan *plan, const BenchResult *results, size_t count, Error *error)
{
    const Args *args = plan->args;
    return (args->quiet || table_print(plan->table, results, count, stdout, error)) &&
           (!args->output || table_draw(plan->table, results, count, args->output, error));
}

/* Notes the case that could not begin. */
static void note_failure(const Plan *plan, size_t index, const Error *error, BenchResult *result)
{
    Scene scene;
    Error none;
    *result = (BenchResult){.failure = *error};
    outcome_not_run(error->message, &result->outcome);
    snprintf(result->scene, sizeof result->scene, "%s", plan->scenes[index / plan->combinations]);
    plan_case_name(plan, index, result->swept, sizeof result->swept);
    if (!plan_case_load(plan, index, false, &scene, &none))
        return;
    snprintf(result->scene, sizeof result->scene, "%s", scene.path);
    memcpy(result->backend, scene.world.backend, sizeof result->backend);
    memcpy(result->method, scene.world.method, sizeof result->method);
    memcpy(result->view, scene.view.kind, sizeof result->view);
}

/* A sweep searches for failing fluids: such rows are results, if at least one case was measured. */
static bool has_worked(const Plan *plan, const Tally *tally)
{
    const size_t failed = tally->fluids + tally->others;
    if (failed > 0 && tally->done > 1)
        fprintf(stderr, "%zu of %zu cases failed\n", failed, tally->done);
    return failed == 0 || (plan->sweep_count > 0 && tally->measured > 0 && tally->others == 0);
}

/* Shows and writes all results, even after a failure; `ok`: no failure ended the work, otherwise *error has
   it. */
static bool report(const Plan *plan, BenchResult *results, Tally *tally, bool ok, Error *error)
{
    const Args *args = plan->args;
    Error reason = {{0}};
    if (!ok && !interrupted()) {
        note_failure(plan, tally->done, error, &results[tally->done]);
        tally->done++;
    }
    bool reported = !ok || interrupted() || !plan->table || tally->measured == 0 ||
                    show_table(plan, results, tally->done, &reason);
    if (args->json && tally->done > 0)
        reported &= bench_write_json(results, tally->done, args->json, &reason);
    if (ok)
        *error = reason;
    return reported;
}

static int bench(const Plan *plan, bool wants_context, Error *error)
{
    const Args *args = plan->args;
    Tally tally = {0};
    Headless *context = NULL;
    BenchResult *results = calloc(plan_cases(plan) + 1, sizeof *results);
    if (!results) {
        error_set(error, "no memory for the results");
        return fail(error, EXIT_FAILED);
    }
    const bool can_write = !args->json || json_file_check(args->json, error);
    bool ok = can_write &&
              (!args->output || (chart_check(args->output, error) && output_check(args->output, error))) &&
              (!wants_context || (context = headless_create(args->gpu, error)));
    if (context)
        fprintf(stderr, "renderer: %s\n", headless_renderer(context));
    ok = ok && measure_all(plan, context, results, &tally, error);
    if (can_write)
        ok = report(plan, results, &tally, ok, error) && ok;
    headless_destroy(context);
    free(results);
    if (!ok)
        return fail(error, interrupted() ? EXIT_INTERRUPTED : EXIT_FAILED);
    return interrupted() ? EXIT_INTERRUPTED : has_worked(plan, &tally) ? 0 : EXIT_FAILED;
}

/* Runs the windows one after another, each with a scene and settings. */
static int bench_play(const Args *args, Error *error)
{
    static const char *const scene = "scenes/box_slosh.yaml";
    const size_t count = args->scene_count ? (size_t)args->scene_count : 1;
    PlayFigures *figures = calloc(count, sizeof *figures);
    if (!figures || (args->json && !json_file_check(args->json, error))) {
        free(figures);
        return fail(error, EXIT_FAILED);
    }
    int code = 0;
    size_t done = 0;
    for (; done < count && code == 0 && !interrupted(); done++) {
        const PlaySetup setup = {.scene = args->scene_count ? args->scenes[done] : scene,
                                 .settings = &args->settings,
                                 .width = args->width,
                                 .height = args->height,
                                 .history_bytes = (size_t)(args->past * 1048576),
                                 .shake_seconds = args->seconds,
                                 .quiet = args->quiet};
        code = play(&setup, &figures[done]);
        if (code == 0 && !args->quiet)
            play_print(&figures[done], stdout);
    }
    if (args->json && !play_write_json_array(figures, done, args->json, error))
        code = fail(error, EXIT_FAILED);
    free(figures);
    return code;
}

int cmd_bench(const Args *args)
{
    Error error = {{0}};
    bool wants_context;
    static Plan plan;
    interrupt_install();
    if (!plan_make(args, &plan, &error) || !device_check(args, &error) ||
        (!args->micro && !args->ablate && !cases_check(&plan, &wants_context, &error)))
        return fail(&error, EXIT_USAGE);
    if (args->ablate)
        return bench_ablate(&plan);
    if (args->micro)
        return bench_micro(&plan);
    if (plan.table && plan.table->points)
        return bench_points(&plan);
    if (args->play)
        return bench_play(args, &error);
    return bench(&plan, wants_context, &error);
}
