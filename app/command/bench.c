#include "app/lab/bench.h"
#include "app/base/interrupt.h"
#include "app/base/json_file.h"
#include "app/command/bench_micro.h"
#include "app/command/bench_plan.h"
#include "app/command/cmd.h"
#include "app/device/devices.h"
#include "app/device/mapping.h"
#include "app/play/play.h"
#include "app/play/report.h"

#include <stdlib.h>
#include <string.h>

enum { DEFAULT_FRAMES = 200, TABLE_FRAMES = 40 };

static GlClock clock_of(ClockChoice choice)
{
    return choice == CLOCK_CHOICE_GL       ? GL_CLOCK_QUERY
           : choice == CLOCK_CHOICE_FINISH ? GL_CLOCK_FINISH
                                           : GL_CLOCK_AUTO;
}

/* --device: a recording that can be played, and a mapping for it. */
static bool device_check(const Args *args, Error *error)
{
    Mapping mapping;
    if (args->device && args->play)
        return error_set(error,
                         "slosh bench: with --play a script shakes the box; leave --device out, or --play");
    return !args->device ||
           (devices_check(args->device, error) && mapping_load(args->mapping, &mapping, error));
}

/* All cases are read before the first runs: a mistake in the last one shows at once. */
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

static bool measure_all(const Plan *plan, Headless *context, BenchResult *results, size_t *done, Error *error)
{
    const Args *args = plan->args;
    const size_t count = plan_cases(plan);
    for (; *done < count && !interrupted(); ++*done) {
        Scene scene;
        Progress progress;
        char swept[256];
        if (!plan_case_load(plan, *done, true, &scene, error))
            return false;
        plan_case_name(plan, *done, swept, sizeof swept);
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
            .from = args->time_given ? args->time : 0,
            .clock = clock_of(args->clock),
            .device = args->device,
            .mapping = args->mapping,
        };
        progress_begin(&progress, stderr, "bench", args->quiet);
        const bool ok = bench_measure(&setup, &progress, (double)*done / (double)count, 1 / (double)count,
                                      &results[*done], error);
        progress_end(&progress);
        if (!ok)
            return false;
        if (!args->quiet && !plan->table)
            bench_print(&results[*done], stdout);
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

/* The case that failed, without figures. */
static void note_failure(const Plan *plan, size_t index, const Error *error, BenchResult *result)
{
    Scene scene;
    Error none;
    *result = (BenchResult){.failure = error->message};
    snprintf(result->scene, sizeof result->scene, "%s", plan->scenes[index / plan->combinations]);
    plan_case_name(plan, index, result->swept, sizeof result->swept);
    if (!plan_case_load(plan, index, false, &scene, &none))
        return;
    snprintf(result->scene, sizeof result->scene, "%s", scene.path);
    memcpy(result->backend, scene.world.backend, sizeof result->backend);
    memcpy(result->method, scene.world.method, sizeof result->method);
    memcpy(result->view, scene.view.kind, sizeof result->view);
}

static int bench(const Plan *plan, bool wants_context, Error *error)
{
    const Args *args = plan->args;
    size_t done = 0;
    Headless *context = NULL;
    BenchResult *results = calloc(plan_cases(plan) + 1, sizeof *results);
    const bool can_write = results && (!args->json || json_file_check(args->json, error));
    bool ok = can_write || (!results && error_set(error, "no memory for the results"));
    if (ok && wants_context)
        ok = (context = headless_create(args->gpu, error)) != NULL;
    if (context)
        fprintf(stderr, "renderer: %s\n", headless_renderer(context));
    ok = ok && measure_all(plan, context, results, &done, error);
    if (ok && plan->table)
        ok = show_table(plan, results, done, error);
    if (can_write && !ok && !interrupted() && done < plan_cases(plan)) {
        note_failure(plan, done, error, &results[done]);
        done++;
    }
    if (can_write && args->json && done > 0) {
        Error json_error = {{0}};
        const bool written = bench_write_json(results, done, args->json, &json_error);
        if (!written && ok)
            *error = json_error;
        ok = ok && written;
    }
    headless_destroy(context);
    free(results);
    if (!ok)
        return fail(error, interrupted() ? EXIT_INTERRUPTED : EXIT_FAILED);
    return interrupted() ? EXIT_INTERRUPTED : 0;
}

/* One window after the other, each with its scene and its settings. */
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
        (!args->micro && !cases_check(&plan, &wants_context, &error)))
        return fail(&error, EXIT_USAGE);
    if (args->micro)
        return bench_micro(&plan);
    if (args->play)
        return bench_play(args, &error);
    return bench(&plan, wants_context, &error);
}
