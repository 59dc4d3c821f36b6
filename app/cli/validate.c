#include "app/base/file.h"
#include "app/base/program.h"
#include "app/bench/bench.h"
#include "app/bench/cases/case.h"
#include "app/bench/plot.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/run/offscreen.h"
#include "sim/start/start.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { RUNS_MAX = 128, CASE_NAME_MAX = 32 };

#define PLOT_NAME "%s/%s.svg"

typedef struct ValidateOptions {
    bool full, coarse; /* finer or coarser than the default set */
} ValidateOptions;

static const ValidateOptions *own(const Args *args)
{
    return args->own;
}

typedef struct ValidatePlan {
    const Args *args;
    CaseLevel level;
    const char *method; /* the only method, or NULL */
    int count;
    CaseSetup setups[RUNS_MAX];
    double work[RUNS_MAX]; /* relative cost of each run */
} ValidatePlan;

/* The method of --method, from the settings. */
static const char *chosen_method(const SceneSettings *settings)
{
    static const char key[] = "solver.method=";
    const char *method = NULL;
    for (int i = 0; i < settings->count; i++)
        if (strncmp(settings->set[i], key, sizeof key - 1) == 0)
            method = settings->set[i] + sizeof key - 1;
    return method;
}

static bool is_planned(const ValidatePlan *plan, const Case *of)
{
    for (int i = 0; i < plan->count; i++)
        if (plan->setups[i].of == of)
            return true;
    return false;
}

static bool add_run(ValidatePlan *plan, const Case *of, const char *method, Error *error)
{
    if (plan->count == RUNS_MAX)
        return error_set(error, "slosh validate: more than %d runs; name fewer cases", RUNS_MAX);
    plan->setups[plan->count++] =
        (CaseSetup){.of = of, .level = plan->level, .method = method, .settings = &plan->args->settings};
    return true;
}

static void say_left_out(const ValidatePlan *plan, const Case *of, const char *method, const char *why)
{
    if (!plan->args->quiet)
        fprintf(stderr, "%s with %s is left out: %s\n", of->name, method, why);
}

/* Adds a case's runs; reports excluded methods with the reason. With --method runs even an excluded
   method. */
static bool add_case(ValidatePlan *plan, const Case *of, Error *error)
{
    if (plan->method)
        return add_run(plan, of, plan->method, error);
    bool ok = true;
    for (const CaseMethod *at = of->methods; ok && at->name; at++)
        if (!at->left_out)
            ok = add_run(plan, of, at->name, error);
        else
            say_left_out(plan, of, at->name, at->left_out);
    for (const Named *method = world_methods(); method->name; method++)
        if (!case_method(of, method->name))
            say_left_out(plan, of, method->name, "what it should reach is not known");
    return ok;
}

/* Cost: particles, times neighbour pairs, times steps by the speed of sound. */
static double work_of(const Case *of, const WorldDef *def)
{
    return (double)seed_count(def, def->spacing) * pow(def->support, def->dimensions) * of->time *
           def->sound_speed / def->spacing;
}

/* Reads all scenes before the first run: a mistake in the last scene shows at once. Reports and skips cases
   that the backend cannot run. */
static bool plan_keep(ValidatePlan *plan, bool *wants_context, Error *error)
{
    Scene scene;
    int kept = 0;
    *wants_context = false;
    for (int i = 0; i < plan->count; i++) {
        const CaseSetup setup = plan->setups[i];
        if (!case_scene(&setup, &scene, error))
            return false;
        if (world_can(&scene.world, error)) {
            *wants_context |= world_on_gpu(&scene.world);
            plan->work[kept] = work_of(setup.of, &scene.world);
            plan->setups[kept++] = setup;
        } else {
            fprintf(stderr, "%s with %s is left out: %s\n", setup.of->name, setup.method, error->message);
        }
    }
    plan->count = kept;
    return kept > 0; /* otherwise `error` has the last reason */
}

static bool plan_make(const Args *args, ValidatePlan *plan, bool *wants_context, Error *error)
{
    bool ok = true;
    *plan = (ValidatePlan){.args = args, .method = chosen_method(&args->settings)};
    plan->level = own(args)->full ? CASE_FULL : own(args)->coarse ? CASE_COARSE : CASE_DEFAULT;
    if (own(args)->full && own(args)->coarse)
        return error_set(error, "slosh validate: --full and --coarse exclude each other; leave one out");
    for (const Case *const *at = case_list; ok && args->scene_count == 0 && *at; at++)
        ok = ((*at)->only_full && !own(args)->full) || add_case(plan, *at, error);
    for (int i = 0; ok && i < args->scene_count; i++) {
        const Case *of = case_find(args->scenes[i], error);
        ok = of && (is_planned(plan, of) || add_case(plan, of, error));
    }
    return ok && plan_keep(plan, wants_context, error);
}

/* Runs a case with case_run, and finds its outcome. */
static bool run_one(const CaseSetup *planned, Progress *progress, double done, double part,
                    CaseResult *result, Outcome *outcome, Error *error)
{
    CaseWatch watch = case_watch_begin(planned->of);
    CaseSetup setup = *planned;
    setup.watch = case_watch;
    setup.watcher = &watch;
    if (!case_run(&setup, progress, done, part, result, error))
        return false;
    case_watch_outcome(&watch, result, outcome);
    return true;
}

static bool run_all(const ValidatePlan *plan, CaseResult *results, Outcome *outcomes, int *done, Error *error)
{
    const Args *args = plan->args;
    Progress progress;
    double all = 0, before = 0;
    bool ok = true;
    for (int i = 0; i < plan->count; i++)
        all += plan->work[i];
    if (!args->quiet)
        validate_print_head(stdout);
    fflush(stdout);
    progress_begin(&progress, stderr, "validate", args->quiet);
    for (; ok && *done < plan->count && !interrupted(); ++*done) {
        const double part = plan->work[*done] / all;
        ok = run_one(&plan->setups[*done], &progress, before, part, &results[*done], &outcomes[*done], error);
        if (!ok)
            break;
        before += part;
        progress_end(&progress);
        if (!args->quiet)
            validate_print(&results[*done], &outcomes[*done], stdout);
    }
    progress_end(&progress);
    return ok;
}

/* Plots DIR/CASE.svg, with all methods of a case in one plot. */
static bool plot_all(const Args *args, const CaseResult *results, int count, Error *error)
{
    if (!args->output)
        return true;
    for (int i = 0, next; i < count; i = next) {
        char path[1024];
        for (next = i + 1; next < count && results[next].of == results[i].of;)
            next++;
        snprintf(path, sizeof path, PLOT_NAME, args->output, results[i].of->name);
        if (!validate_plot(&results[i], (size_t)(next - i), path, error))
            return false;
    }
    return true;
}

/* Makes the folder for plots, and checks that it is writable. */
static bool make_folder(const char *path, Error *error)
{
    char probe[1024];
    if (mkdir(path, 0777) != 0 && errno != EEXIST)
        return error_set(error, "%s: cannot be made (%s); name a folder for the plots", path,
                         strerror(errno));
    if (snprintf(probe, sizeof probe, PLOT_NAME, path, "plot") >= (int)sizeof probe - CASE_NAME_MAX)
        return error_set(error, "the name of the folder has more than %zu bytes; name a shorter one",
                         sizeof probe - CASE_NAME_MAX);
    return output_check(probe, error);
}

static int count_missed(const CaseResult *results, int count, FILE *file)
{
    int all = 0, misses = 0;
    for (int i = 0; i < count; i++)
        for (int m = 0; m < CASE_METRICS && results[i].of->metrics[m].name; m++) {
            all += !results[i].of->metrics[m].no_verdict;
            misses += !case_passed(&results[i], m);
        }
    if (file)
        fprintf(file, "%d of %d figure%s within tolerance\n", all - misses, all, plural((size_t)all));
    return misses;
}

/* Writes all results so far, even after a failure. */
static int finish(const ValidatePlan *plan, const CaseResult *results, const Outcome *outcomes, int done,
                  bool ran, Error *error)
{
    const Args *args = plan->args;
    Error no_json, no_plot;
    const char *failure = ran ? NULL : error->message;
    const bool written =
        !args->json || validate_write_json(results, outcomes, (size_t)done, failure, args->json, &no_json);
    const bool drawn = plot_all(args, results, done, &no_plot);
    if (!written)
        fprintf(stderr, "%s\n", no_json.message);
    if (!drawn)
        fprintf(stderr, "%s\n", no_plot.message);
    if (interrupted()) {
        fprintf(stderr, "stopped after %d of %d runs\n", done, plan->count);
        return EXIT_INTERRUPTED;
    }
    if (!ran)
        fprintf(stderr, "%s\n", error->message);
    const bool missed = count_missed(results, done, args->quiet ? NULL : stdout) > 0;
    return ran && written && drawn && !missed ? 0 : EXIT_FAILED;
}

/* Reports a failure before any run. */
static int fail(const char *json, const Error *error)
{
    Error no_json;
    fprintf(stderr, "%s\n", error->message);
    if (json && !validate_write_json(NULL, NULL, 0, error->message, json, &no_json))
        fprintf(stderr, "%s\n", no_json.message);
    return EXIT_FAILED;
}

static int validate(const ValidatePlan *plan, bool wants_context, Error *error)
{
    const Args *args = plan->args;
    int done = 0;
    Headless *context = NULL;
    CaseResult *results = calloc((size_t)plan->count + 1, sizeof *results);
    Outcome *outcomes = calloc((size_t)plan->count + 1, sizeof *outcomes);
    const bool can_write = !args->json || json_file_check(args->json, error);
    bool ok = can_write && ((results && outcomes) || error_set(error, "no memory for the results")) &&
              (!args->output || (plot_check(args->output, error) && make_folder(args->output, error)));
    if (ok && wants_context)
        ok = (context = headless_create(args->gpu, error)) != NULL;
    if (context)
        renderer_tell(headless_renderer(context));
    int code;
    if (ok) {
        const bool ran = run_all(plan, results, outcomes, &done, error);
        code = finish(plan, results, outcomes, done, ran, error);
    } else {
        code = fail(can_write ? args->json : NULL, error);
    }
    for (int i = 0; results && i < plan->count; i++)
        case_result_free(&results[i]);
    headless_destroy(context);
    free(outcomes);
    free(results);
    return code;
}

static int run_command(const Args *args)
{
    ValidatePlan plan = {0};
    Error error = {{0}};
    bool wants_context = false;
    interrupt_install();
    if (plan_make(args, &plan, &wants_context, &error))
        return validate(&plan, wants_context, &error);
    fprintf(stderr, "%s\n", error.message);
    return EXIT_USAGE;
}

/* clang-format off */
static const OptionRow options[] = {
    ROW_OUTPUT("DIR", .files = files_replaced, .pattern = "*.svg", .help = "a folder for a plot a case, with the reference on it"),
    {"--full", NULL, OPTION_FLAG, OWN(ValidateOptions, full), .help = "finer, for as long as it takes"},
    {"--coarse", NULL, OPTION_FLAG, OWN(ValidateOptions, coarse), .help = "a glance: few particles, with tolerances of its own"},
    ROWS_SCENE, ROWS_PROCESSOR, ROW_GPU, ROW_SHADERS, ROW_DEVICE_REFUSED("what is compared moves as the scene says, and no other way"),
    ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_validate = {
    .name = "validate",
    .usage = "[CASE...] [OPTIONS]",
    .help = "known flows against their references; without a CASE, all",
    .takes = "case",
    .takes_max = ARGS_SCENES_MAX,
    .own_size = sizeof(ValidateOptions),
    .options = options,
    .run = run_command,
};
