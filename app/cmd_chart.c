#include "app/chart.h"
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

static void add_job(Plan *plan, ChartJob job)
{
    static Scene scene;
    ChartRow row;
    Error why = {{0}};
    if (plan->count == JOBS_MAX)
        return;
    if (!chart_prepare(&plan->subject, &job, &scene, &row, &why)) {
        if (!plan->args->quiet && job.coarsening == coarsenings[0] && job.fineness == 0)
            fprintf(stderr, "left out: %s\n", why.message);
        return;
    }
    plan->work[plan->count] = pow(job.coarsening, -scene.world.dimensions - 1) * (1 << job.fineness);
    plan->jobs[plan->count++] = job;
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
    add_job(plan, (ChartJob){CHART_REFERENCE, method, backend, finest, 1, 0});
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

static bool plan_make(const Args *args, Plan *plan, Error *error)
{
    static Scene scene;
    SceneSettings settings = args->settings;
    char note[256];
    *plan = (Plan){.args = args};
    if (!chart_name(args->output, error))
        return false;
    for (int s = 0; s < args->sweep_count; s++)
        if (strcmp(args->sweeps[s].key, "solver.method") != 0 &&
            strcmp(args->sweeps[s].key, "solver.backend") != 0)
            return error_set(error, "slosh chart: --sweep takes method or backend here, not '%.60s'",
                             args->sweeps[s].key);
    snprintf(plan->csv, sizeof plan->csv, "%.1000s", args->output);
    memcpy(strrchr(plan->csv, '.'), ".csv", sizeof ".csv");
    plan->subject = (ChartSubject){.scene = args->scenes[0],
                                   .time = args->time_given ? args->time : DEFAULT_TIME,
                                   .settings = &args->settings};
    Error none;
    plan->subject.of = case_find(args->scenes[0], &none);
    if (plan->subject.time <= 0)
        return error_set(error, "slosh chart: --time must be more than 0");
    if (!plan->subject.of && !scene_load(args->scenes[0], &settings, &scene, note, error))
        return false;
    if (!plan_jobs(plan, error))
        return false;
    return plan->count > 0 || error_set(error, "slosh chart: nothing of it can run here");
}

/* Rows of this plan in the plan's order, taken from `kept` or run anew; the file is written after each. */
static bool run_all(const Plan *plan, ChartRows *kept, ChartRows *rows, Error *error)
{
    static Scene scene;
    Progress progress;
    double all = 0, done = 0;
    bool ok = true;
    for (int i = 0; i < plan->count; i++)
        all += plan->work[i];
    progress_begin(&progress, stderr, "chart", plan->args->quiet);
    for (int i = 0; ok && i < plan->count && !interrupted(); i++) {
        ChartRow *row = &rows->row[rows->count];
        ok = chart_prepare(&plan->subject, &plan->jobs[i], &scene, row, error);
        const ChartRow *old = ok ? chart_rows_find(kept, row->key) : NULL;
        if (old)
            *row = *old;
        else
            ok = ok && chart_run(&plan->subject, &plan->jobs[i], row, &progress, done / all,
                                 plan->work[i] / all, error);
        done += plan->work[i];
        rows->count += ok;
        if (ok && !old && kept->count < CHART_ROWS_MAX) {
            kept->row[kept->count++] = *row;
            ok = chart_rows_write(kept, plan->csv, error);
        }
        progress_update(&progress, done / all);
    }
    progress_end(&progress);
    return ok && !interrupted();
}

/* Older runs of other settings stay in the file. */
static void keep_errors(ChartRows *kept, const ChartRows *rows)
{
    for (int i = 0; i < rows->count; i++) {
        ChartRow *row = chart_rows_find(kept, rows->row[i].key);
        if (row)
            row->error = rows->row[i].error;
    }
}

static void print_rows(const ChartRows *rows, double floor)
{
    printf("%-8s %-8s %-12s %10s %9s %14s %9s\n", "method", "backend", "step", "spacing, m", "particles",
           "s a simulated s", "error");
    for (int i = 0; i < rows->count; i++) {
        const ChartRow *row = &rows->row[i];
        if (row->role != CHART_FLOOR)
            printf("%-8s %-8s %-12s %10.4g %9zu %14.4g %7.3g %%%s\n", row->method, row->backend, row->step,
                   row->spacing, row->particles, row->seconds, 100 * row->error,
                   row->role == CHART_REFERENCE ? "  the reference"
                   : !isfinite(row->seconds)    ? "  broke"
                   : chart_on_front(rows, i)    ? "  best for its time"
                                                : "");
    }
    if (isfinite(floor))
        printf("three runs that differ by 1e-6 of a spacing: %.3g %% apart\n", 100 * floor);
}

static bool finish(const Plan *plan, ChartRows *kept, ChartRows *rows, Error *error)
{
    char title[256], name[128];
    const Case *of = plan->subject.of;
    const double floor = chart_rows_compare(rows);
    keep_errors(kept, rows);
    if (!plan->args->quiet)
        print_rows(rows, floor);
    snprintf(title, sizeof title, "%.120s%s", of ? of->help : plan->args->scenes[0],
             of ? "" : ": the finest run is the reference");
    snprintf(name, sizeof name, "error: %s", of ? of->metrics[0].name : "centre and energy, rms over range");
    return chart_rows_write(kept, plan->csv, error) &&
           chart_draw(rows, title, name, floor, plan->args->output, error);
}

static int chart(const Plan *plan, Error *error)
{
    static ChartRows kept, rows;
    static Scene scene;
    ChartRow row;
    Headless *context = NULL;
    bool gpu = false;
    for (int i = 0; i < plan->count; i++)
        gpu |=
            chart_prepare(&plan->subject, &plan->jobs[i], &scene, &row, error) && world_on_gpu(&scene.world);
    bool ok = output_check(plan->args->output, error) && output_check(plan->csv, error);
    if (ok && gpu)
        ok = (context = headless_create(plan->args->gpu, error)) != NULL;
    chart_rows_read(&kept, plan->csv);
    ok = ok && run_all(plan, &kept, &rows, error) && finish(plan, &kept, &rows, error);
    headless_destroy(context);
    if (interrupted()) {
        fprintf(stderr, "stopped after %d of %d runs; the same command goes on\n", rows.count, plan->count);
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
