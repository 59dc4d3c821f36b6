#include "app/chart.h"
#include "app/chart_report.h"
#include "app/chart_run.h"
#include "app/cmd.h"
#include "app/headless.h"
#include "app/interrupt.h"
#include "app/output.h"

#include <math.h>
#include <string.h>

enum { JOBS_MAX = 200, NAMES_MAX = 8 };

static const double coarsenings[] = {2, 1.5, 1}; /* fills that are whole numbers of spacings often stay so */
static const double finest = 0.5;                /* of a scene's reference */
static const double jitters[] = {1e-6, 2e-6, 3e-6};
static const double DEFAULT_TIME = 2; /* s, of a scene */

typedef struct Plan {
    const Args *args;
    ChartSubject subject;
    char csv[1024];
    int count;
    ChartJob jobs[JOBS_MAX];
    double work[JOBS_MAX]; /* about how long each takes, up to a factor */
    bool made[JOBS_MAX];   /* by an older run */
    double left;           /* the sum of `work` of the others */
    bool on_gpu;           /* one of the others */
} Plan;

/* The last setting of that key on the command line, or NULL. */
static const char *set_value(const SceneSettings *settings, const char *key)
{
    const size_t length = strlen(key);
    const char *value = NULL;
    for (int i = 0; i < settings->count; i++)
        if (strncmp(settings->set[i], key, length) == 0 && settings->set[i][length] == '=')
            value = settings->set[i] + length + 1;
    return value;
}

/* What --sweep or the option says for the key; else those given, ended by NULL. How many. */
static int names_of(const Args *args, const char *key, const char *const others[],
                    const char *names[NAMES_MAX])
{
    int count = 0;
    const char *one = set_value(&args->settings, key);
    for (int s = 0; s < args->sweep_count; s++)
        for (int v = 0; strcmp(args->sweeps[s].key, key) == 0 && v < args->sweeps[s].count; v++)
            if (count < NAMES_MAX)
                names[count++] = args->sweeps[s].values[v];
    if (count == 0 && one)
        names[count++] = one;
    for (int i = 0, found = count; found == 0 && i < NAMES_MAX && others && others[i]; i++)
        names[count++] = others[i];
    return count;
}

/* A reason that holds for several jobs is said once. */
static void say_left_out(const char *why)
{
    static char last[sizeof(Error)];
    if (strcmp(last, why) != 0)
        fprintf(stderr, "left out: %s\n", why);
    snprintf(last, sizeof last, "%s", why);
}

/* False with the reason where it cannot be made. */
static bool try_job(Plan *plan, ChartJob job, Error *why)
{
    static Scene scene;
    ChartRow row;
    if (plan->count == JOBS_MAX)
        return error_set(why, "more than %d runs; name fewer methods or backends", JOBS_MAX);
    if (!chart_prepare(&plan->subject, &job, &scene, &row, why))
        return false;
    plan->work[plan->count] = pow(job.coarsening, -scene.world.dimensions - 1) * (1 << job.fineness);
    plan->jobs[plan->count++] = job;
    return true;
}

static void add_job(Plan *plan, ChartJob job)
{
    Error why = {{0}};
    if (!try_job(plan, job, &why))
        say_left_out(why.message);
}

/* A scene has no reference of its own: the finest run with its own method is one, and three runs that differ
   by next to nothing say below which distance nothing is known. */
static bool add_reference(Plan *plan, const char *backend, Error *error)
{
    static Scene scene;
    char note[256];
    SceneSettings settings = plan->args->settings;
    if (!scene_load(plan->subject.scene, &settings, &scene, note, error))
        return false;
    static char method[NAME_SIZE];
    snprintf(method, sizeof method, "%s", scene.world.method);
    Error why = {{0}};
    if (!try_job(plan, (ChartJob){CHART_REFERENCE, method, backend, finest, 1, 0}, &why))
        return error_set(error,
                         "slosh chart: the run at %g of the spacing, which all are compared with, cannot be "
                         "made: %.700s",
                         finest, why.message);
    for (size_t i = 0; i < sizeof jitters / sizeof *jitters; i++)
        add_job(plan, (ChartJob){CHART_FLOOR, method, backend, 1, 0, jitters[i]});
    return true;
}

static bool plan_jobs(Plan *plan, Error *error)
{
    const Args *args = plan->args;
    const char *all[NAMES_MAX] = {NULL}, *methods[NAMES_MAX], *backends[NAMES_MAX] = {NULL};
    for (int i = 0; !plan->subject.of && i < NAMES_MAX - 1 && world_methods()[i].name; i++)
        all[i] = world_methods()[i].name;
    const int m =
        names_of(args, "solver.method", plan->subject.of ? plan->subject.of->methods : all, methods);
    const int b = names_of(args, "solver.backend", NULL, backends);
    for (int at = 0; at < m * (b ? b : 1); at++)
        for (int fine = 0; fine < 2; fine++)
            for (size_t c = 0; c < sizeof coarsenings / sizeof *coarsenings; c++)
                add_job(plan,
                        (ChartJob){CHART_POINT, methods[at % m], backends[at / m], coarsenings[c], fine, 0});
    return plan->subject.of || add_reference(plan, backends[0], error);
}

/* Whether the scene can be read with each of the values. */
static bool sweep_check(const Plan *plan, const Sweep *sweep, Error *error)
{
    static Scene scene;
    char text[128], note[256];
    const ChartSubject *subject = &plan->subject;
    const bool of_method = strcmp(sweep->key, "solver.method") == 0;
    bool ok = of_method || strcmp(sweep->key, "solver.backend") == 0 ||
              error_set(error, "slosh chart: --sweep takes method or backend here, not '%.60s'", sweep->key);
    for (int v = 0; ok && v < sweep->count; v++) {
        SceneSettings settings = *subject->settings;
        const char *method = of_method || !subject->of ? sweep->values[v] : subject->of->methods[0];
        snprintf(text, sizeof text, "%.60s=%.60s", sweep->key, sweep->values[v]);
        settings.set[settings.count < SCENE_SETTINGS_MAX ? settings.count++ : settings.count - 1] = text;
        const CaseSetup setup = {subject->of, CASE_DEFAULT, method, &settings};
        ok = subject->of ? case_scene(&setup, &scene, error)
                         : scene_load(subject->scene, &settings, &scene, note, error);
    }
    return ok;
}

/* OUT.csv beside OUT.svg. */
static bool name_csv(Plan *plan, Error *error)
{
    const char *output = plan->args->output;
    if (!chart_name(output, error))
        return false;
    if (strlen(output) >= sizeof plan->csv)
        return error_set(error, "the name of the chart has more than %zu bytes; name a shorter one",
                         sizeof plan->csv - 1);
    snprintf(plan->csv, sizeof plan->csv, "%s", output);
    memcpy(strrchr(plan->csv, '.'), ".csv", sizeof ".csv");
    return true;
}

/* A case's name, or a scene's. */
static bool find_subject(Plan *plan, Error *error)
{
    static Scene scene;
    const Args *args = plan->args;
    SceneSettings settings = args->settings;
    Error no_case, no_scene;
    char note[256];
    plan->subject = (ChartSubject){.scene = args->scenes[0],
                                   .time = args->time_given ? args->time : DEFAULT_TIME,
                                   .settings = &args->settings};
    plan->subject.of = case_find(args->scenes[0], &no_case);
    if (plan->subject.time <= 0)
        return error_set(error, "slosh chart: --time must be more than 0");
    if (plan->subject.of)
        return !args->time_given ||
               error_set(error, "slosh chart: the case %s has a time of its own; leave --time out",
                         plan->subject.of->name);
    if (scene_load(args->scenes[0], &settings, &scene, note, &no_scene))
        return true;
    const char *near = case_near(args->scenes[0]);
    return near ? error_set(error, "%.700s; did you mean the case '%s'?", no_scene.message, near)
                : error_set(error, "%s", no_scene.message);
}

static bool plan_make(const Args *args, Plan *plan, Error *error)
{
    *plan = (Plan){.args = args};
    if (!name_csv(plan, error) || !find_subject(plan, error))
        return false;
    for (int s = 0; s < args->sweep_count; s++)
        if (!sweep_check(plan, &args->sweeps[s], error))
            return false;
    return plan_jobs(plan, error) &&
           (plan->count > 0 || error_set(error, "slosh chart: nothing of it can run here"));
}

/* Rows of this plan in its order, with the figures of those that `kept` has. */
static bool make_rows(Plan *plan, const ChartRows *kept, ChartRows *rows, Error *error)
{
    static Scene scene;
    for (rows->count = 0; rows->count < plan->count; rows->count++) {
        const int i = rows->count;
        if (!chart_prepare(&plan->subject, &plan->jobs[i], &scene, &rows->row[i], error))
            return false;
        const ChartRow *old = chart_rows_find(kept, rows->row[i].key);
        plan->made[i] = old != NULL;
        if (old) {
            rows->row[i] = *old;
            continue;
        }
        plan->left += plan->work[i];
        plan->on_gpu |= world_on_gpu(&scene.world);
    }
    return true;
}

/* Those that are not made yet; the file is written after each. How many are then there. */
static bool run_all(const Plan *plan, ChartRows *kept, ChartRows *rows, int *there, Error *error)
{
    Progress progress;
    double done = 0;
    bool ok = true;
    progress_begin(&progress, stderr, "chart", plan->args->quiet);
    for (int i = 0; i < plan->count; i++)
        *there += plan->made[i];
    for (int i = 0; ok && i < plan->count && !interrupted(); i++) {
        if (plan->made[i])
            continue;
        const double part = plan->work[i] / plan->left;
        ok = chart_run(&plan->subject, &plan->jobs[i], &rows->row[i], &progress, done, part, error);
        if (!ok)
            break;
        done += part;
        ++*there;
        chart_rows_add(kept, &rows->row[i], rows);
        chart_rows_merge(kept, plan->csv, rows);
        ok = chart_rows_write(kept, plan->csv, error);
        progress_update(&progress, done);
    }
    progress_end(&progress);
    return ok && !interrupted();
}

/* Older runs of other settings stay in the file. */
static void keep_errors(ChartRows *kept, const ChartRows *rows)
{
    for (int i = 0; i < kept->count; i++) {
        const ChartRow *row = chart_rows_find(rows, kept->row[i].key);
        if (row)
            kept->row[i].error = row->error;
    }
}

/* A chart without an error on it is a failure. */
static bool check_rows(const Plan *plan, const ChartRows *rows, Error *error)
{
    int known = 0;
    if (!plan->subject.of && !chart_rows_reference(rows))
        return error_set(error, "the finest run, which all are compared with, broke: no error is known; use "
                                "a smaller step or a larger spacing");
    for (int i = 0; i < rows->count; i++)
        known += rows->row[i].role == CHART_POINT && isfinite(rows->row[i].error);
    return known > 0 || error_set(error, "every run broke: no error is known; use a smaller step");
}

static bool finish(const Plan *plan, ChartRows *kept, ChartRows *rows, Error *error)
{
    char title[256], name[128];
    const Args *args = plan->args;
    const Case *of = plan->subject.of;
    const double floor = chart_rows_compare(rows);
    keep_errors(kept, rows);
    if (!args->quiet)
        chart_print(rows, floor, stdout);
    snprintf(title, sizeof title, "%.120s%s", of ? of->help : args->scenes[0],
             of ? "" : ": the finest run is the reference");
    snprintf(name, sizeof name, "error: %s", of ? of->metrics[0].name : "centre and energy, rms over range");
    chart_rows_merge(kept, plan->csv, rows);
    return chart_rows_write(kept, plan->csv, error) &&
           (!args->json ||
            chart_write_json(rows, args->scenes[0], name + strlen("error: "), floor, args->json, error)) &&
           chart_draw(rows, title, name, floor, args->output, error) && check_rows(plan, rows, error);
}

static bool check_outputs(const Plan *plan, ChartRows *kept, Error *error)
{
    const Args *args = plan->args;
    return output_check(args->output, error) && output_check(plan->csv, error) &&
           (!args->json || output_check(args->json, error)) && chart_rows_read(kept, plan->csv, error);
}

static int chart(Plan *plan, Error *error)
{
    static ChartRows kept, rows;
    Headless *context = NULL;
    int there = 0;
    bool ok = check_outputs(plan, &kept, error) && make_rows(plan, &kept, &rows, error);
    if (ok && plan->on_gpu)
        ok = (context = headless_create(plan->args->gpu, error)) != NULL;
    if (context)
        fprintf(stderr, "renderer: %s\n", headless_renderer(context));
    ok = ok && run_all(plan, &kept, &rows, &there, error) && finish(plan, &kept, &rows, error);
    headless_destroy(context);
    if (interrupted()) {
        fprintf(stderr, "stopped after %d of %d runs; the same command goes on\n", there, plan->count);
        return EXIT_INTERRUPTED;
    }
    if (!ok)
        fprintf(stderr, "%s\n", error->message);
    return ok ? 0 : EXIT_FAILED;
}

int cmd_chart(const Args *args)
{
    static Plan plan;
    Error error = {{0}};
    interrupt_install();
    if (plan_make(args, &plan, &error))
        return chart(&plan, &error);
    fprintf(stderr, "%s\n", error.message);
    return EXIT_USAGE;
}
