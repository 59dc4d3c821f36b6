/* The plan of `slosh bench`: scenes, and the settings of each case. */
#include "app/bench/bench.h"
#include "app/base/file.h"
#include "app/base/program.h"
#include "app/bench/plot.h"
#include "app/cli/args/args.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/input/device/device.h"
#include "app/input/input.h"
#include "app/lab/ablate.h"
#include "app/run/offscreen.h"
#include "app/scene/scene.h"
#include "app/window/play.h"
#include "sim/start/start.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Each scene with each combination of the sweeps' values; the last sweep varies fastest. */
typedef struct BenchPlan {
    const Args *args;
    const char *const *scenes;
    size_t scene_count, combinations;
    const BenchTable *table; /* or NULL */
    SceneSettings settings;
    int sweep_count;
    Sweep sweeps[ARGS_SWEEPS_MAX];
    const char *narrowed[ARGS_SWEEPS_MAX]; /* for a table: source of the single value, as in SceneSettings */
} BenchPlan;

static const char *const default_scenes[] = {"scenes/dam_break.yaml", "scenes/box_slosh.yaml"};

_Static_assert(BENCH_TABLE_SWEEPS + 1 <= ARGS_SWEEPS_MAX, "a table's sweeps have room");

/* Narrows the table's sweep of that setting to the single value. */
static bool narrow(BenchPlan *plan, const char *setting, const char *said)
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

/* Puts the table's own settings first, so that the command line overrides them. */
static bool plan_table(BenchPlan *plan, Error *error)
{
    const Args *args = plan->args;
    plan->table = bench_table_find(options_of_bench(args)->table, error);
    if (!plan->table)
        return false;
    if (args->scene_count || args->sweep_count || options_of_bench(args)->play)
        return error_set(error,
                         "slosh bench: --table brings its own scenes and sweeps; leave the others out");
    plan->scene_count = bench_table_scenes(plan->table, &plan->scenes);
    plan->sweep_count = bench_table_sweeps(plan->table, plan->sweeps);
    plan->settings.count = 0;
    for (int i = 0; i < BENCH_TABLE_SETTINGS && plan->table->settings[i]; i++)
        if (!scene_settings_add(&plan->settings, NULL, plan->table->settings[i], error))
            return false;
    for (int i = 0; i < args->settings.count; i++)
        if (!narrow(plan, args->settings.set[i], args->settings.said[i]) &&
            !scene_settings_add(&plan->settings, args->settings.said[i], args->settings.set[i], error))
            return false;
    return true;
}

/* Measures single passes at several counts. */
static bool plan_micro(BenchPlan *plan, Error *error)
{
    static const Sweep counts = {
        .key = "particles", .count = 5, .values = {"10000", "30000", "100000", "1000000", "4000000"}};
    const Args *args = plan->args;
    bool chosen = args->settings.particles > 0;
    if (options_of_bench(args)->table || options_of_bench(args)->play || args->device)
        return error_set(error, "slosh bench: --micro stands alone; leave --table, --play and --device out");
    for (int i = 0; i < plan->sweep_count; i++) {
        assert(plan->sweeps[i].key);
        chosen |= strcmp(plan->sweeps[i].key, counts.key) == 0;
    }
    if (chosen)
        return true;
    if (plan->sweep_count == ARGS_SWEEPS_MAX)
        return error_set(error, "slosh bench: too many sweeps beside that of particles; use --particles N");
    plan->sweeps[plan->sweep_count++] = counts;
    return true;
}

static bool bench_plan_make(const Args *args, BenchPlan *plan, Error *error)
{
    const BenchOptions *own = options_of_bench(args);
    *plan = (BenchPlan){.args = args,
                        .scenes = args->scenes,
                        .scene_count = (size_t)args->scene_count,
                        .settings = args->settings,
                        .sweep_count = args->sweep_count};
    memcpy(plan->sweeps, args->sweeps, sizeof plan->sweeps);
    if (own->table && !plan_table(plan, error))
        return false;
    if (args->output && (own->micro || own->ablate || own->play))
        return error_set(error, "slosh bench: -o draws the stages of frames, or a --table; leave it out");
    if (args->output && !plot_check_name(args->output, error))
        return false;
    if (plan->scene_count == 0) {
        plan->scenes = default_scenes;
        plan->scene_count = own->micro ? 1 : sizeof default_scenes / sizeof *default_scenes;
    }
    if (own->micro && !plan_micro(plan, error))
        return false;
    for (int i = 0; i < plan->sweep_count; i++)
        if (plan->sweeps[i].count < 1)
            return error_set(error, "the sweep of %s has no values", plan->sweeps[i].key);
    plan->combinations = sweeps_combinations(plan->sweeps, plan->sweep_count);
    return true;
}

/* Names for messages of the swept settings of a case, with the settings themselves. */
typedef char SweptTexts[ARGS_SWEEPS_MAX][SWEEP_SAID];

static bool case_settings(const BenchPlan *plan, size_t combination, SweptTexts texts,
                          SceneSettings *settings, Error *error)
{
    *settings = plan->settings;
    for (int i = plan->sweep_count - 1; i >= 0; i--) {
        const int before = settings->count;
        if (!sweep_set(plan->sweeps[i].key, sweeps_value(plan->sweeps, plan->sweep_count, i, combination),
                       "--sweep", texts[i], settings, error))
            return false;
        if (plan->table && settings->count > before)
            settings->said[before] = plan->narrowed[i];
    }
    return true;
}

static size_t bench_plan_cases(const BenchPlan *plan)
{
    return plan->scene_count * plan->combinations;
}

/* Name of the case among the cases of its scene, for people; "" without sweeps. */
static void bench_plan_case_name(const BenchPlan *plan, size_t index, char *name, size_t size)
{
    sweeps_name(plan->sweeps, plan->sweep_count, index % plan->combinations, "=", name, size);
}

static bool load_case(const BenchPlan *plan, size_t index, Scene *scene, Notes *notes, Error *error)
{
    SweptTexts texts;
    SceneSettings settings;
    const size_t number = index / plan->combinations;
    if (!case_settings(plan, index % plan->combinations, texts, &settings, error))
        return false;
    if (plan->table && !plan->table->scene && settings.particles == 0)
        settings.particles = bench_table_particles(plan->table, number);
    return scene_load(plan->scenes[number], &settings, scene, notes, error);
}

/* Prints the notes of a case, without notes of the case before. */
static void tell_notes(const BenchPlan *plan, size_t index, Notes *notes)
{
    Scene scene;
    Notes before = {.count = 0};
    Error none;
    int kept = 0;
    if (index > 0 && !load_case(plan, index - 1, &scene, &before, &none))
        before.count = 0;
    for (int i = 0; i < notes->count; i++)
        if (!notes_have(&before, notes->line[i]))
            memmove(notes->line[kept++], notes->line[i], NOTE_SIZE);
    notes->count = kept;
    notes_print(notes, stderr);
}

/* Loads the scene of a case; `tell`: prints the loader's notes on standard error. */
static bool bench_plan_case_load(const BenchPlan *plan, size_t index, bool tell, Scene *scene, Error *error)
{
    Notes notes;
    if (!load_case(plan, index, scene, &notes, error))
        return false;
    if (tell)
        tell_notes(plan, index, &notes);
    return true;
}

/* `slosh bench --micro`. */

typedef struct Micro {
    const BenchPlan *plan;
    Ceilings ceilings;
    MicroResult *results;
    size_t count;
    double ms_a_particle; /* least time of the last case, ms per particle */
    bool broke;           /* a simulation broke before --time */
} Micro;

/* Reads all cases before the first run, with few particles: too many particles are no mistake of the command
   line. */
static bool micro_cases_check(const BenchPlan *plan, Error *error)
{
    BenchPlan few = *plan;
    for (int i = 0; i < few.sweep_count; i++) {
        assert(few.sweeps[i].key != NULL);
        if (strcmp(few.sweeps[i].key, "particles") != 0)
            continue;
        for (int k = 1; k < few.sweeps[i].count; k++)
            few.sweeps[i].values[k] = few.sweeps[i].values[0];
    }
    for (size_t i = 0; i < bench_plan_cases(&few); i++) {
        Scene scene;
        if (!bench_plan_case_load(&few, i, false, &scene, error) || !world_can(&scene.world, error))
            return false;
        if (world_on_gpu(&scene.world))
            return error_set(error, "slosh bench: --micro measures the backend cpu; leave %s out",
                             scene.world.backend);
    }
    return true;
}

static void leave_out(Micro *micro, size_t index, const char *why)
{
    MicroResult *result = &micro->results[micro->count++];
    snprintf(result->scene, sizeof result->scene, "%s",
             micro->plan->scenes[index / micro->plan->combinations]);
    bench_plan_case_name(micro->plan, index, result->swept, sizeof result->swept);
    snprintf(result->left_out, sizeof result->left_out, "%.500s", why);
    if (!micro->plan->args->quiet)
        micro_print(result, stdout);
}

static double particles_of(const Scene *scene)
{
    size_t counts[FLUIDS_MAX], all = 0;
    seed_counts(&scene->world, counts);
    for (int f = 0; f < scene->world.fluid_count; f++)
        all += counts[f];
    return (double)all;
}

/* True if the case may be tried, judged by the time of the last case. */
static bool within_limits(Micro *micro, size_t index, Scene *scene)
{
    Error error;
    char why[256];
    if (!bench_plan_case_load(micro->plan, index, true, scene, &error)) {
        leave_out(micro, index, error.message);
        return false;
    }
    const double limit = options_of_bench(micro->plan->args)->seconds,
                 expected = 1e-3 * micro->ms_a_particle * particles_of(scene);
    if (expected <= limit)
        return true;
    snprintf(why, sizeof why, "by the last case it would take %.3g s; use --seconds %.3g", expected,
             2 * expected);
    leave_out(micro, index, why);
    return false;
}

/* Measures a case; skips a world that exceeds memory, and a state that the simulation did not reach. */
static void measure_case(Micro *micro, size_t index, const Scene *scene)
{
    Error error;
    const Args *args = micro->plan->args;
    const MicroSetup setup = {.scene = scene,
                              .rounds = options_of_bench(args)->frames,
                              .seconds = options_of_bench(args)->seconds,
                              .from = args_given(args, "--time") ? args->time : 0};
    int found;
    MicroResult *results = &micro->results[micro->count];
    const bool first = micro->ceilings.copies == 0;
    const bool ok = micro_measure(&setup, &micro->ceilings, results, &found, &error);
    if (first && found > 0 && !args->quiet)
        micro_print_ceilings(&micro->ceilings, results[0].threads, stdout);
    for (int k = 0; k < found; k++) {
        bench_plan_case_name(micro->plan, index, results[k].swept, sizeof results[k].swept);
        if (!args->quiet)
            micro_print(&results[k], stdout);
    }
    micro->count += (size_t)found;
    if (found > 0 && results[0].particles > 0)
        micro->ms_a_particle = results[0].least_ms / (double)results[0].particles;
    if (ok || interrupted())
        return;
    micro->broke |= found > 0;
    leave_out(micro, index, error.message);
}

static void micro_measure_all(Micro *micro)
{
    for (size_t i = 0; i < bench_plan_cases(micro->plan) && !interrupted(); i++) {
        Scene scene;
        if (within_limits(micro, i, &scene))
            measure_case(micro, i, &scene);
    }
}

/* Measures the plan's cases; returns the exit code. */
static int bench_micro(const BenchPlan *plan)
{
    Error error = {{0}};
    const Args *args = plan->args;
    Micro micro = {.plan = plan};
    if (!micro_cases_check(plan, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return EXIT_USAGE;
    }
    assert(bench_plan_cases(plan) > 0);
    micro.results = calloc(2 * bench_plan_cases(plan), sizeof *micro.results);
    if (!micro.results) {
        fprintf(stderr, "no memory for the results\n");
        return EXIT_FAILED;
    }
    bool ok = !args->json || json_file_check(args->json, &error);
    if (ok)
        micro_measure_all(&micro);
    if (ok && args->json && micro.count > 0)
        ok = micro_write_json(micro.results, micro.count, &micro.ceilings, args->json, &error);
    free(micro.results);
    if (!ok)
        fprintf(stderr, "%s\n", error.message);
    return interrupted() ? EXIT_INTERRUPTED : ok && !micro.broke ? 0 : EXIT_FAILED;
}

/* `slosh bench --table paper001`. */

enum { USUAL_POINTS = 4000000, USUAL_FRAMES = 5 };

static bool render(const BenchPlan *plan, PointsFigures *figures, Error *error)
{
    const Args *args = plan->args;
    BenchPlan alone = *plan; /* --particles is for the points */
    Scene scene;
    Progress progress;
    alone.settings.particles = 0;
    if (!bench_plan_case_load(&alone, 0, false, &scene, error))
        return false;
    Headless *context = headless_create(args->gpu, error);
    if (!context)
        return false;
    const BenchSetup setup = {.scene = &scene,
                              .context = context,
                              .draws = true,
                              .width = args->width,
                              .height = args->height,
                              .frames = options_of_bench(args)->frames ? options_of_bench(args)->frames
                                                                       : USUAL_FRAMES,
                              .clock = GL_CLOCK_AUTO};
    progress_begin(&progress, stderr, "bench", args->quiet);
    const bool ok = bench_measure(&setup, &progress, 0, 1, &figures->rendering);
    progress_end(&progress);
    headless_destroy(context);
    return ok || error_set(error, "%s", figures->rendering.failure.message);
}

static bool measure(const BenchPlan *plan, Error *error)
{
    const Args *args = plan->args;
    PointsFigures figures = {0};
    Reference reference;
    const size_t asked = plan->settings.particles;
    if ((args->json && !json_file_check(args->json, error)) ||
        !reference_load(plan->table->reference, &reference, error) ||
        !points_sampling((double)(asked ? asked : USUAL_POINTS), &figures, error) ||
        !render(plan, &figures, error))
        return false;
    if (!(points_shown(&figures.rendering) > 0))
        return error_set(error, "slosh bench: no point of %s was shown, or memory was short to count them",
                         figures.rendering.scene);
    if (!args->quiet)
        points_print(&figures, &reference, stdout);
    return !args->json || points_write_json(&figures, args->json, error);
}

/* Measures sampling, then the table's scene; returns the exit code. */
static int bench_points(const BenchPlan *plan)
{
    Error error = {{0}};
    if (plan->args->output) {
        fprintf(stderr, "slosh bench: the table %s has no chart; leave -o out\n", plan->table->name);
        return EXIT_USAGE;
    }
    if (measure(plan, &error))
        return 0;
    fprintf(stderr, "%s\n", error.message);
    return interrupted() ? EXIT_INTERRUPTED : EXIT_FAILED;
}

/* `slosh bench --ablate`. */

static const double DEFAULT_TIME = 2; /* s */

static bool names_view(const SceneSettings *settings)
{
    bool named = false;
    for (int i = 0; i < settings->count; i++)
        named |= settings->said[i] && strncmp(settings->said[i], "--view ", strlen("--view ")) == 0;
    return named;
}

/* Names an option without effect, or NULL. */
static const char *has_no_place(const Args *args)
{
    const BenchOptions *own = options_of_bench(args);
    return own->table                      ? "--table"
           : own->play                     ? "--play"
           : own->micro                    ? "--micro"
           : args->device                  ? "--device"
           : args->sweep_count > 0         ? "--sweep"
           : own->frames > 0               ? "--frames"
           : own->clock                    ? "--clock"
           : args_given(args, "--size")    ? "--size"
           : args_given(args, "--seconds") ? "--seconds"
           : names_view(&args->settings)   ? "--view"
                                           : NULL;
}

/* Reads all scenes before the first run. */
static bool scenes_check(const BenchPlan *plan, bool *context, Error *error)
{
    Scene scene;
    const Args *args = plan->args;
    *context = false;
    const char *other = has_no_place(args);
    if (other)
        return error_set(error, "slosh bench: --ablate stands alone; leave %s out", other);
    if (args_given(args, "--time") && !(args->time > 0))
        return error_set(error, "slosh bench: --ablate needs a --time of more than 0");
    for (size_t i = 0; i < bench_plan_cases(plan); i++) {
        if (!bench_plan_case_load(plan, i, false, &scene, error) || !world_can(&scene.world, error))
            return false;
        *context |= world_on_gpu(&scene.world);
    }
    return true;
}

/* Returns false if a scene fails; the following scenes still run. */
static bool ablate_all(const BenchPlan *plan, const Headless *context, Ablation *ablations, size_t *done)
{
    const Args *args = plan->args;
    bool ok = true;
    for (*done = 0; *done < bench_plan_cases(plan) && !interrupted(); (*done)++) {
        Ablation *one = &ablations[*done];
        Error error = {{0}};
        const AblateSetup setup = {.scene = plan->scenes[*done],
                                   .settings = &plan->settings,
                                   .time = args_given(args, "--time") ? args->time : DEFAULT_TIME,
                                   .quiet = args->quiet};
        if (!ablate(&setup, one, &error)) {
            fprintf(stderr, "%s\n", error.message);
            ok = false;
        }
        snprintf(one->renderer, sizeof one->renderer, "%s", context ? headless_renderer(context) : "");
        if (!args->quiet)
            ablate_print(one, stdout);
    }
    return ok;
}

/* Measures each scene of the plan without each of its terms; returns the exit code. */
static int bench_ablate(const BenchPlan *plan)
{
    Error error = {{0}};
    const Args *args = plan->args;
    bool wants_context;
    size_t done = 0;
    if (!scenes_check(plan, &wants_context, &error)) {
        fprintf(stderr, "%s\n", error.message);
        return EXIT_USAGE;
    }
    Headless *context = NULL;
    assert(bench_plan_cases(plan) > 0);
    Ablation *ablations = calloc(bench_plan_cases(plan), sizeof *ablations);
    bool ok = ablations ? !args->json || json_file_check(args->json, &error)
                        : error_set(&error, "no memory for the results");
    ok = ok && (!wants_context || (context = headless_create(args->gpu, &error)));
    if (context)
        renderer_tell(headless_renderer(context));
    const bool ran = ok && ablate_all(plan, context, ablations, &done);
    ok = ok && (!args->json || done == 0 || ablate_write_json(ablations, done, args->json, &error));
    headless_destroy(context);
    free(ablations);
    if (!ok)
        fprintf(stderr, "%s\n", error.message);
    return interrupted() ? EXIT_INTERRUPTED : ok && ran ? 0 : EXIT_FAILED;
}

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
    if (args->device && options_of_bench(args)->play)
        return error_set(error,
                         "slosh bench: with --play a script shakes the box; leave --device out, or --play");
    return !args->device ||
           (devices_check(args->device, error) && mapping_load(args->mapping, &mapping, error));
}

/* Reads all cases before the first run: a mistake in the last case shows at once. */
static bool cases_check(const BenchPlan *plan, bool *context, Error *error)
{
    *context = false;
    for (size_t i = 0; i < bench_plan_cases(plan); i++) {
        Scene scene;
        if (!bench_plan_case_load(plan, i, false, &scene, error) || !world_can(&scene.world, error))
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

static bool measure_one(const BenchPlan *plan, size_t at, Headless *context, BenchResult *result,
                        Error *error)
{
    const Args *args = plan->args;
    const BenchOptions *own = options_of_bench(args);
    const double part = 1 / (double)bench_plan_cases(plan);
    Scene scene;
    Progress progress;
    char swept[256];
    if (!bench_plan_case_load(plan, at, true, &scene, error))
        return false;
    bench_plan_case_name(plan, at, swept, sizeof swept);
    const BenchSetup setup = {
        .scene = &scene,
        .swept = swept,
        .context = context,
        .draws = strcmp(scene.view.kind, "none") != 0,
        .width = args->width,
        .height = args->height,
        .frames = own->frames   ? own->frames
                  : plan->table ? TABLE_FRAMES
                                : DEFAULT_FRAMES,
        .seconds = plan->table ? plan->table->seconds : 0,
        .from = args_given(args, "--time") ? args->time : 0,
        .clock = clock_of(own->clock),
        .device = args->device,
        .mapping = args->mapping,
    };
    progress_begin(&progress, stderr, "bench", args->quiet);
    bench_measure(&setup, &progress, (double)at * part, part, result);
    progress_end(&progress);
    return true;
}

static bool measure_all(const BenchPlan *plan, Headless *context, BenchResult *results, Tally *tally,
                        Error *error)
{
    while (tally->done < bench_plan_cases(plan) && !interrupted()) {
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

static bool show_table(const BenchPlan *plan, const BenchResult *results, size_t count, Error *error)
{
    const Args *args = plan->args;
    return (args->quiet || bench_table_print(plan->table, results, count, stdout, error)) &&
           (!args->output || bench_table_draw(plan->table, results, count, args->output, error));
}

/* Notes the case that could not begin. */
static void note_failure(const BenchPlan *plan, size_t index, const Error *error, BenchResult *result)
{
    Scene scene;
    Error none;
    *result = (BenchResult){.failure = *error};
    outcome_not_run(error->message, &result->outcome);
    snprintf(result->scene, sizeof result->scene, "%s", plan->scenes[index / plan->combinations]);
    bench_plan_case_name(plan, index, result->swept, sizeof result->swept);
    if (!bench_plan_case_load(plan, index, false, &scene, &none))
        return;
    snprintf(result->scene, sizeof result->scene, "%s", scene.path);
    memcpy(result->backend, scene.world.backend, sizeof result->backend);
    memcpy(result->method, scene.world.method, sizeof result->method);
    memcpy(result->view, scene.view.kind, sizeof result->view);
}

/* A sweep searches for failing fluids: such rows are results, if at least one case was measured. */
static bool has_worked(const BenchPlan *plan, const Tally *tally)
{
    const size_t failed = tally->fluids + tally->others;
    if (failed > 0 && tally->done > 1)
        fprintf(stderr, "%zu of %zu cases failed\n", failed, tally->done);
    return failed == 0 || (plan->sweep_count > 0 && tally->measured > 0 && tally->others == 0);
}

/* Shows and writes all results, even after a failure; `ok`: no failure ended the work, otherwise *error has
   it. */
static bool report(const BenchPlan *plan, BenchResult *results, Tally *tally, bool ok, Error *error)
{
    const Args *args = plan->args;
    Error reason = {{0}};
    if (!ok && !interrupted()) {
        note_failure(plan, tally->done, error, &results[tally->done]);
        tally->done++;
    }
    bool reported =
        !ok || interrupted() || tally->measured == 0 ||
        (plan->table ? show_table(plan, results, tally->done, &reason)
                     : !args->output || bench_stages_draw(results, tally->done, args->output, &reason));
    if (args->json && tally->done > 0)
        reported &= bench_write_json(results, tally->done, args->json, &reason);
    if (ok)
        *error = reason;
    return reported;
}

static int bench(const BenchPlan *plan, bool wants_context, Error *error)
{
    const Args *args = plan->args;
    Tally tally = {0};
    Headless *context = NULL;
    BenchResult *results = calloc(bench_plan_cases(plan) + 1, sizeof *results);
    if (!results) {
        error_set(error, "no memory for the results");
        return fail(error, EXIT_FAILED);
    }
    const bool can_write = !args->json || json_file_check(args->json, error);
    bool ok = can_write &&
              (!args->output || (plot_check(args->output, error) && output_check(args->output, error))) &&
              (!wants_context || (context = headless_create(args->gpu, error)));
    if (context)
        renderer_tell(headless_renderer(context));
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
                                 .history_bytes = (size_t)(PLAY_HISTORY_MIB * 1048576.0),
                                 .shake_seconds = options_of_bench(args)->seconds,
                                 .quiet = args->quiet};
        code = play(&setup, &figures[done]);
        if (code == 0 && !args->quiet)
            play_figures_print(&figures[done], stdout);
    }
    if (args->json && !play_figures_write_json_array(figures, done, args->json, error))
        code = fail(error, EXIT_FAILED);
    free(figures);
    return code;
}

static int run_command(const Args *args)
{
    const BenchOptions *own = options_of_bench(args);
    Error error = {{0}};
    bool wants_context;
    BenchPlan plan = {0};
    interrupt_install();
    if (!bench_plan_make(args, &plan, &error) || !device_check(args, &error) ||
        (!own->micro && !own->ablate && !cases_check(&plan, &wants_context, &error)))
        return fail(&error, EXIT_USAGE);
    if (own->ablate)
        return bench_ablate(&plan);
    if (own->micro)
        return bench_micro(&plan);
    if (plan.table && plan.table->points)
        return bench_points(&plan);
    if (own->play)
        return bench_play(args, &error);
    return bench(&plan, wants_context, &error);
}

/* clang-format off */
static const OptionRow options[] = {
    ROW_OUTPUT("OUT", .files = files_replaced, .help = "a chart, OUT.svg or OUT.png: the stages of each case, or the --table"),
    {"--table", "NAME", OPTION_TEXT, OWN(BenchOptions, table), .help = "a published table again, beside its figures", .names = bench_table_choice},
    ROW_TIME(0, "measure from the first frame at or after that time on (0)"),
    ROW_FRAMES(BenchOptions),
    ROW_PICTURE_SIZE,
    {"--play", NULL, OPTION_FLAG, OWN(BenchOptions, play), .help = "measure the live window, the box shaken by a script"},
    {"--seconds", "S", OPTION_NUMBER, .initial = 20, .offset = offsetof(BenchOptions, seconds), .max = 1e5, .flags = OPTION_OWN | OPTION_OPEN_LOW,
     .help = "how long, with --play; with --micro at most, for one count of particles (20)"},
    {"--micro", NULL, OPTION_FLAG, OWN(BenchOptions, micro),
     .help = "each pass of a method alone on cpu, at 10000 to 4000000 particles, beside what the machine could do; with --time S at that time too"},
    {"--ablate", NULL, OPTION_FLAG, OWN(BenchOptions, ablate),
     .help = "what each term of the scene's model costs, and what its metrics change without it: --time S simulated seconds (2) without each, in turn"},
    {"--clock", "gl|finish", OPTION_CHOICE, OWN(BenchOptions, clock), .min = CLOCK_CHOICE_GL,
     .help = "GPU stages by GL timer queries, or by glFinish and the CPU's clock"},
    {"--sweep", "KEY=A,B,...", OPTION_SWEEP, AT(sweeps),
     .help = "measure with each value: particles, backend, method, view, threads or any scene key; repeat for a product"},
    ROWS_SCENE, ROW_VIEW, ROW_PRESET, ROWS_PROCESSOR, ROW_GPU, ROW_SHADERS, ROWS_DEVICE_MOVES, ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_bench = {
    .name = "bench",
    .usage = "[SCENE...] [OPTIONS]",
    .help = "measures how long each stage of a frame takes",
    .takes = "scene",
    .takes_max = ARGS_SCENES_MAX,
    .width = 512,
    .height = 512,
    .own_size = sizeof(BenchOptions),
    .argument_files = files_scene,
    .options = options,
    .run = run_command,
};
