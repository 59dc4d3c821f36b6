#include "app/lab/bench.h"
#include "app/base/interrupt.h"
#include "app/base/json_file.h"
#include "app/command/cmd.h"
#include "app/device/devices.h"
#include "app/device/mapping.h"
#include "app/lab/bench_table.h"
#include "app/lab/chart.h"
#include "app/play/play.h"
#include "app/play/report.h"

#include <stdlib.h>
#include <string.h>

enum { DEFAULT_FRAMES = 200, TABLE_FRAMES = 40 };

static const char *const default_scenes[] = {"scenes/dam_break.yaml", "scenes/box_slosh.yaml"};

/* Each scene with each combination of the sweeps' values; the last sweep runs fastest. */
typedef struct Plan {
    const Args *args;
    const char *const *scenes;
    size_t scene_count, combinations;
    const Table *table; /* or NULL */
    SceneSettings settings;
    int sweep_count;
    Sweep sweeps[ARGS_SWEEPS_MAX];
    const char *narrowed[ARGS_SWEEPS_MAX]; /* of a table: what said the one value, as SceneSettings has it */
} Plan;

_Static_assert(TABLE_SWEEPS + 1 <= ARGS_SWEEPS_MAX, "a table's sweeps have room");

/* A setting of what a table sweeps: that one value. */
static bool narrow(Plan *plan, const char *setting, const char *said)
{
    for (int i = 0; i < plan->sweep_count; i++) {
        Sweep *sweep = &plan->sweeps[i];
        const size_t key = strlen(sweep->key);
        if (strncmp(setting, sweep->key, key) == 0 && setting[key] == '=') {
            sweep->count = 1;
            sweep->values[0] = setting + key + 1;
            plan->narrowed[i] = said;
            return true;
        }
    }
    return false;
}

/* The table's own settings come first, so that the command line may say otherwise. */
static bool plan_table(Plan *plan, Error *error)
{
    const Args *args = plan->args;
    int count = 0;
    plan->table = table_find(args->table, error);
    if (!plan->table)
        return false;
    if (args->scene_count || args->sweep_count || args->play)
        return error_set(error,
                         "slosh bench: --table brings its own scenes and sweeps; leave the others out");
    if (args->output && !chart_name(args->output, error))
        return false;
    plan->scenes = &plan->table->scene;
    plan->scene_count = 1;
    plan->sweep_count = table_sweeps(plan->table, plan->sweeps);
    memset(plan->settings.said, 0, sizeof plan->settings.said);
    for (int i = 0; i < TABLE_SETTINGS && plan->table->settings[i]; i++)
        plan->settings.set[count++] = plan->table->settings[i];
    for (int i = 0; i < args->settings.count; i++) {
        if (count == SCENE_SETTINGS_MAX)
            return error_set(error, "more than %d settings; write them into the scene file",
                             SCENE_SETTINGS_MAX);
        if (narrow(plan, args->settings.set[i], args->settings.said[i]))
            continue;
        plan->settings.said[count] = args->settings.said[i];
        plan->settings.set[count++] = args->settings.set[i];
    }
    plan->settings.count = count;
    return true;
}

static bool plan_make(const Args *args, Plan *plan, Error *error)
{
    *plan = (Plan){.args = args,
                   .scenes = args->scenes,
                   .scene_count = (size_t)args->scene_count,
                   .combinations = 1,
                   .settings = args->settings,
                   .sweep_count = args->sweep_count};
    memcpy(plan->sweeps, args->sweeps, sizeof plan->sweeps);
    if (args->table && !plan_table(plan, error))
        return false;
    if (args->output && !args->table)
        return error_set(error, "slosh bench: -o is the chart of a --table; name one, or leave it out");
    if (plan->scene_count == 0) {
        plan->scenes = default_scenes;
        plan->scene_count = sizeof default_scenes / sizeof *default_scenes;
    }
    for (int i = 0; i < plan->sweep_count; i++)
        plan->combinations *= (size_t)plan->sweeps[i].count;
    return true;
}

/* Words for the swept settings of one case: what messages call them, with the setting itself behind. */
typedef char SweptTexts[ARGS_SWEEPS_MAX][512];

static bool case_settings(const Plan *plan, size_t combination, SweptTexts texts, SceneSettings *settings,
                          Error *error)
{
    *settings = plan->settings;
    for (int i = plan->sweep_count - 1; i >= 0; i--) {
        const Sweep *sweep = &plan->sweeps[i];
        if (sweep->count < 1)
            return error_set(error, "the sweep of %s has no values", sweep->key);
        const char *value = sweep->values[combination % (size_t)sweep->count];
        combination /= (size_t)sweep->count;
        if (strcmp(sweep->key, "particles") == 0) {
            settings->particles = strtoul(value, NULL, 10);
            continue;
        }
        if (settings->count == SCENE_SETTINGS_MAX)
            return error_set(error, "more than %d settings; write them into the scene file",
                             SCENE_SETTINGS_MAX);
        snprintf(texts[i], sizeof texts[i], "--sweep %s=%s", sweep->key, value);
        settings->said[settings->count] = plan->table ? plan->narrowed[i] : texts[i];
        settings->set[settings->count++] = texts[i] + strlen("--sweep ");
    }
    return true;
}

/* What tells the case from the others, for people. */
static void case_name(const Plan *plan, size_t combination, char *name, size_t size)
{
    size_t used = 0, behind = plan->combinations;
    snprintf(name, size, "%s", "");
    for (int i = 0; i < plan->sweep_count && used < size; i++) {
        const Sweep *sweep = &plan->sweeps[i];
        behind /= (size_t)sweep->count;
        used += (size_t)snprintf(name + used, size - used, "%s%s=%s", i ? ", " : "", sweep->key,
                                 sweep->values[combination / behind % (size_t)sweep->count]);
    }
}

static bool case_load(const Plan *plan, size_t index, bool tell, Scene *scene, Error *error)
{
    SweptTexts texts;
    Notes notes;
    SceneSettings settings;
    if (!case_settings(plan, index % plan->combinations, texts, &settings, error) ||
        !scene_load(plan->scenes[index / plan->combinations], &settings, scene, &notes, error))
        return false;
    if (tell)
        notes_print(&notes, stderr);
    return true;
}

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
    for (size_t i = 0; i < plan->scene_count * plan->combinations; i++) {
        Scene scene;
        if (!case_load(plan, i, false, &scene, error) || !world_can(&scene.world, error))
            return false;
        *context |= world_on_gpu(&scene.world) || strcmp(scene.view.kind, "none") != 0;
    }
    return true;
}

static bool measure_all(const Plan *plan, Headless *context, BenchResult *results, size_t *done, Error *error)
{
    const Args *args = plan->args;
    const size_t count = plan->scene_count * plan->combinations;
    for (; *done < count && !interrupted(); ++*done) {
        Scene scene;
        Progress progress;
        char swept[256];
        if (!case_load(plan, *done, true, &scene, error))
            return false;
        case_name(plan, *done % plan->combinations, swept, sizeof swept);
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
    case_name(plan, index % plan->combinations, result->swept, sizeof result->swept);
    if (!case_load(plan, index, false, &scene, &none))
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
    BenchResult *results = calloc(plan->scene_count * plan->combinations + 1, sizeof *results);
    const bool can_write = results && (!args->json || json_file_check(args->json, error));
    bool ok = can_write || (!results && error_set(error, "no memory for the results"));
    if (ok && wants_context)
        ok = (context = headless_create(args->gpu, error)) != NULL;
    if (context)
        fprintf(stderr, "renderer: %s\n", headless_renderer(context));
    ok = ok && measure_all(plan, context, results, &done, error);
    if (ok && plan->table)
        ok = show_table(plan, results, done, error);
    if (can_write && !ok && !interrupted() && done < plan->scene_count * plan->combinations) {
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
        !cases_check(&plan, &wants_context, &error))
        return fail(&error, EXIT_USAGE);
    if (args->play)
        return bench_play(args, &error);
    return bench(&plan, wants_context, &error);
}
