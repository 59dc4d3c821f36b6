#include "app/bench/cases/case.h"
#include "app/cli/args/args.h"
#include "app/lab/error_chart.h"
#include "app/run/measure/measure.h"
#include "app/scene/scene.h"
#include "sim/gpu/gl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double DEFAULT_TIME = 2; /* s, of a scene */

bool chart_subject_find(const Args *args, ChartSubject *subject, Scene *scene, Notes *notes, Error *error)
{
    const char *command = args->command->name;
    SceneSettings settings = args->settings;
    Error no_case, no_scene;
    settings.purpose = SCENE_FOR_CHART;
    *subject = (ChartSubject){.of = case_find(args->scenes[0], &no_case),
                              .scene = args->scenes[0],
                              .time = args_given(args, "--time") ? args->time : DEFAULT_TIME,
                              .settings = &args->settings};
    if (subject->time <= 0)
        return error_set(error, "slosh %s: --time must be more than 0", command);
    if (subject->of && args_given(args, "--time"))
        return error_set(error, "slosh %s: the case %s has a time of its own; leave --time out", command,
                         subject->of->name);
    const CaseSetup setup = {.of = subject->of,
                             .level = CASE_DEFAULT,
                             .method = subject->of ? subject->of->methods[0].name : NULL,
                             .settings = &settings};
    if (subject->of)
        return case_scene(&setup, scene, error);
    if (scene_load(args->scenes[0], &settings, scene, notes, &no_scene))
        return true;
    const char *near = case_suggest(args->scenes[0]);
    char *hint = strstr(no_scene.message, "; did you mean '");
    if (near && hint)
        *hint = 0; /* one hint is enough */
    return near ? error_set(error, "%.700s; did you mean the case '%s'?", no_scene.message, near)
                : error_set(error, "%s", no_scene.message);
}

void chart_error_name(const ChartSubject *subject, const Scene *scene, char name[256])
{
    size_t used = 0;
    if (subject->of) {
        snprintf(name, 256, "%s", subject->of->metrics[0].name);
        return;
    }
    for (int m = 0; m < scene->metric_count && used < 200; m++)
        used += (size_t)snprintf(name + used, 256 - used, "%s%s",
                                 m == 0                         ? ""
                                 : m + 1 == scene->metric_count ? " and "
                                                                : ", ",
                                 metric_kinds[scene->metrics[m]].name);
    if (used < 256)
        snprintf(name + used, 256 - used, ", rms over range");
}

const char *chart_set_value(const SceneSettings *settings, const char *key)
{
    const size_t length = strlen(key);
    const char *value = NULL;
    for (int i = 0; i < settings->count; i++)
        if (strncmp(settings->set[i], key, length) == 0 && settings->set[i][length] == '=')
            value = settings->set[i] + length + 1;
    return value;
}

static const char SPACING[] = "particles.spacing";

static bool begins(const char *text, const char *with)
{
    return strncmp(text, with, strlen(with)) == 0;
}

int sweep_names(const Args *args, const char *key, const char *names[SWEEP_NAMES_MAX])
{
    int count = 0;
    const char *one = chart_set_value(&args->settings, key);
    for (int s = 0; s < args->sweep_count; s++)
        for (int v = 0; strcmp(args->sweeps[s].key, key) == 0 && v < args->sweeps[s].count; v++)
            if (count < SWEEP_NAMES_MAX)
                names[count++] = args->sweeps[s].values[v];
    if (count == 0 && one)
        names[count++] = one;
    return count;
}

/* True if the plan sweeps the key as methods, backends or spacings. */
static bool has_own_place(const char *key)
{
    return strcmp(key, "solver.method") == 0 || strcmp(key, "solver.backend") == 0 ||
           strcmp(key, SPACING) == 0;
}

static bool can_take(const Sweep *sweep, Error *error)
{
    if (strcmp(sweep->key, "particles") == 0)
        return error_set(error, "slosh chart: --sweep particles has no place here; use --sweep %s=A,B,...",
                         SPACING);
    if (begins(sweep->key, "view.") || begins(sweep->key, "hand.") || strcmp(sweep->key, "title") == 0 ||
        strcmp(sweep->key, "metrics") == 0)
        return error_set(error, "slosh chart: --sweep %.60s changes no run; sweep what a simulation reads",
                         sweep->key);
    return true;
}

/* Takes the sweeps of the command line. Returns false with the reason for a key not possible in a chart.
   The caller must check if the scene can be read with the values. */
static bool chart_sweeps_take(const Args *args, ChartSweeps *sweeps, Error *error)
{
    *sweeps = (ChartSweeps){.count = 0};
    for (int s = 0; s < args->sweep_count; s++) {
        const Sweep *sweep = &args->sweeps[s];
        if (!can_take(sweep, error))
            return false;
        if (has_own_place(sweep->key))
            continue;
        const int k = sweeps->count++;
        sweeps->key[k] = sweep->key;
        sweeps->values[k] = sweep->count;
        for (int v = 0; v < sweep->count; v++)
            if (snprintf(sweeps->text[k][v], SWEPT_TEXT, "--sweep %s=%s", sweep->key, sweep->values[v]) >=
                SWEPT_TEXT)
                return error_set(error, "slosh chart: a value of --sweep %.60s is too long", sweep->key);
    }
    return true;
}

/* Returns the count of combinations; 1 without sweeps. */
static int chart_sweeps_combinations(const ChartSweeps *sweeps)
{
    int all = 1;
    for (int k = 0; k < sweeps->count && all <= CHART_ROWS_MAX; k++)
        all *= sweeps->values[k];
    return all;
}

/* Adds the settings of a combination to the job; keys without effect (see `effect`) are skipped. Returns
   false if the combination differs from an earlier combination only in keys without effect. */
static bool chart_sweeps_set(const ChartSweeps *sweeps, const bool effect[CHART_SWEEPS], int combination,
                             ChartJob *job)
{
    int value[CHART_SWEEPS] = {0};
    bool anew = true;
    job->set_count = 0;
    for (int k = sweeps->count - 1; k >= 0; k--) {
        value[k] = combination % sweeps->values[k];
        combination /= sweeps->values[k];
        anew &= effect[k] || value[k] == 0;
    }
    for (int k = 0; k < sweeps->count; k++)
        if (effect[k])
            job->set[job->set_count++] = sweeps->text[k][value[k]];
    return anew;
}

/* Fails if a key has no effect with any method. */
static bool chart_sweeps_check(const ChartSweeps *sweeps, Error *error)
{
    for (int k = 0; k < sweeps->count; k++)
        if (!sweeps->effective[k])
            return error_set(error,
                             "slosh chart: --sweep %.60s changes nothing: no method of the chart reads it",
                             sweeps->key[k]);
    return true;
}

static int descending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

/* Fills in the spacings of --sweep particles.spacing as multiples of the scene's spacing, coarsest first.
   Returns their count, 0 without the sweep; -1 with the reason if a value is no number above 0, or there
   are too many. */
static int chart_sweeps_spacings(const Args *args, double spacing, double coarsenings[CHART_SPACINGS],
                                 Error *error)
{
    int count = 0;
    for (int s = 0; s < args->sweep_count; s++)
        for (int v = 0; strcmp(args->sweeps[s].key, SPACING) == 0 && v < args->sweeps[s].count; v++) {
            const double length = strtod(args->sweeps[s].values[v], NULL);
            if (count == CHART_SPACINGS || !(length > 0)) {
                error_set(error, "slosh chart: --sweep %s takes up to %d lengths above 0, not '%.60s'",
                          SPACING, CHART_SPACINGS, args->sweeps[s].values[v]);
                return -1;
            }
            coarsenings[count++] = length / spacing;
        }
    qsort(coarsenings, (size_t)count, sizeof *coarsenings, descending);
    return count;
}

static const double coarsenings[] = {2, 1.5, 1}; /* whole layers of fills often stay whole */
static const double FINEST = 0.5;                /* spacing of the reference, times the finest of these */
static const double jitters[] = {1e-6, 2e-6, 3e-6};

/* Returns the count of methods: those of the case, or all. */
static int methods_of(const ChartPlan *plan, const char *methods[CHART_NAMES_MAX])
{
    int count = sweep_names(plan->args, "solver.method", methods);
    if (count > 0)
        return count;
    if (plan->subject.of)
        for (const CaseMethod *at = plan->subject.of->methods; at->name && count < CHART_NAMES_MAX; at++)
            if (!at->left_out)
                methods[count++] = at->name;
            else
                fprintf(stderr, "left out: %s with %s, %s\n", plan->subject.of->name, at->name, at->left_out);
    else
        for (; count < CHART_NAMES_MAX && world_methods()[count].name; count++)
            methods[count] = world_methods()[count].name;
    return count;
}

/* Returns true if there is a GPU; creates the context on the first call. */
static bool has_gpu(ChartPlan *plan)
{
    Error error = {{0}};
    if (!plan->context)
        plan->context = headless_create(plan->args->gpu, &error);
    return plan->context && !gl_renderer_is_software();
}

/* Writes one note about all left out backends. */
static void note_left_out(ChartPlan *plan, const char *const left[], int count)
{
    char names[128] = "";
    for (int i = 0; i < count; i++)
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%.30s", i ? ", " : "", left[i]);
    if (count > 0)
        snprintf(plan->note, sizeof plan->note,
                 "backend %s left out: %s; --sweep backend=... runs them all the same", names,
                 plan->context ? "no GPU here, only a software renderer" : "no OpenGL 4.5 here");
}

/* The scene's own backend is first: the reference runs with it. */
static int backends_of(ChartPlan *plan, const char *backends[CHART_NAMES_MAX])
{
    const char *left[CHART_NAMES_MAX];
    int count = sweep_names(plan->args, "solver.backend", backends), left_count = 0;
    if (count > 0)
        return count;
    backends[count++] = plan->scene.world.backend;
    for (const Named *at = world_backends(); at->name && count < CHART_NAMES_MAX; at++) {
        WorldDef def = plan->scene.world;
        Error why = {{0}};
        snprintf(def.backend, sizeof def.backend, "%s", at->name);
        if (strcmp(at->name, backends[0]) == 0 || !world_can(&def, &why))
            continue;
        if (!world_on_gpu(&def) || has_gpu(plan))
            backends[count++] = at->name;
        else
            left[left_count++] = at->name;
    }
    note_left_out(plan, left, left_count);
    return count;
}

/* Prints a reason once, even if several jobs share it. */
static void say_left_out(const char *why)
{
    static char last[sizeof(Error)];
    if (strcmp(last, why) != 0)
        fprintf(stderr, "left out: %s\n", why);
    snprintf(last, sizeof last, "%s", why);
}

/* Adds a job to the plan. Returns false with the reason if the job's scene cannot be made. */
static bool try_job(ChartPlan *plan, ChartJob job, Error *why)
{
    Scene scene;
    ChartRow row;
    if (plan->count == CHART_JOBS_MAX)
        return error_set(why, "more than %d runs; name fewer methods, backends or swept values",
                         CHART_JOBS_MAX);
    if (!chart_prepare(&plan->subject, &job, &scene, &row, NULL, why))
        return false;
    plan->wants_context |= world_on_gpu(&scene.world);
    plan->work[plan->count] = pow(job.coarsening, -scene.world.dimensions - 1) * (1 << job.fineness);
    plan->jobs[plan->count++] = job;
    return true;
}

static void add_job(ChartPlan *plan, ChartJob job)
{
    Error why = {{0}};
    if (!try_job(plan, job, &why))
        say_left_out(why.message);
}

/* A scene has no reference of its own: the finest run with the scene's method serves as reference. Three
   runs with jitters about 1e-6 spacings apart give the floor: smaller errors are unknown. */
static bool add_reference(ChartPlan *plan, const char *backend, Error *error)
{
    const double least = plan->coarsenings[plan->coarsening_count - 1];
    ChartJob job = {.role = CHART_REFERENCE,
                    .method = plan->scene.world.method,
                    .backend = backend,
                    .coarsening = FINEST * least,
                    .fineness = 1};
    Error why = {{0}};
    if (!try_job(plan, job, &why))
        return error_set(error,
                         "slosh chart: the run at %g of the spacing, which all are compared with, cannot be "
                         "made: %.700s",
                         FINEST * least, why.message);
    job.role = CHART_FLOOR;
    job.coarsening = least;
    job.fineness = 0;
    for (size_t i = 0; i < sizeof jitters / sizeof *jitters; i++) {
        job.jitter = jitters[i];
        add_job(plan, job);
    }
    return true;
}

/* Loads the scene or case with one more setting. */
static bool load_with(const ChartPlan *plan, const char *method, const char *text, Scene *scene, Error *error)
{
    const ChartSubject *subject = &plan->subject;
    SceneSettings settings = *subject->settings;
    const CaseSetup setup = {
        .of = subject->of, .level = CASE_DEFAULT, .method = method, .settings = &settings};
    if (!scene_settings_add(&settings, text, text + strlen("--sweep "), error))
        return false;
    return subject->of ? case_scene(&setup, scene, error)
                       : scene_load(subject->scene, &settings, scene, NULL, error);
}

/* Finds the swept keys with an effect on a method; for the remaining keys one run is enough. */
static void find_effects(ChartPlan *plan, const char *method, bool effect[CHART_SWEEPS])
{
    Scene scene;
    char text[96], why[NOTE_SIZE];
    Error error;
    snprintf(text, sizeof text, "--sweep solver.method=%s", method);
    const bool read = load_with(plan, method, text, &scene, &error);
    for (int k = 0; k < plan->sweeps.count; k++) {
        effect[k] = !read || key_has_effect(&scene, plan->sweeps.key[k], why);
        plan->sweeps.effective[k] |= read && effect[k];
        if (!effect[k])
            fprintf(stderr, "%s is not swept with method %s: %s\n", plan->sweeps.key[k], method, why);
    }
}

static void add_points(ChartPlan *plan, ChartJob job)
{
    for (job.fineness = 0; job.fineness < 2; job.fineness++)
        for (int c = 0; c < plan->coarsening_count; c++) {
            job.coarsening = plan->coarsenings[c];
            add_job(plan, job);
        }
}

static bool plan_jobs(ChartPlan *plan, Error *error)
{
    const char *methods[CHART_NAMES_MAX], *backends[CHART_NAMES_MAX];
    bool effect[CHART_NAMES_MAX][CHART_SWEEPS] = {{0}};
    const int m = methods_of(plan, methods), b = backends_of(plan, backends);
    const int all = chart_sweeps_combinations(&plan->sweeps);
    for (int i = 0; i < m; i++)
        find_effects(plan, methods[i], effect[i]);
    if (m > 0 && !chart_sweeps_check(&plan->sweeps, error))
        return false;
    for (int at = 0; at < m * b * all; at++) {
        const int method = at / all % m;
        ChartJob job = {.role = CHART_POINT, .method = methods[method], .backend = backends[at / all / m]};
        if (chart_sweeps_set(&plan->sweeps, effect[method], at % all, &job))
            add_points(plan, job);
    }
    return plan->subject.of || add_reference(plan, backends[0], error);
}

/* Returns true if the scene can be read with each of the values, by its own method. */
static bool sweep_check(const ChartPlan *plan, const Sweep *sweep, Error *error)
{
    Scene scene;
    char text[SWEPT_TEXT];
    const bool of_method = strcmp(sweep->key, "solver.method") == 0;
    bool ok = true;
    for (int v = 0; ok && v < sweep->count; v++) {
        const Case *of = plan->subject.of;
        snprintf(text, sizeof text, "--sweep %.60s=%.100s", sweep->key, sweep->values[v]);
        ok = load_with(plan, of && !of_method ? of->methods[0].name : sweep->values[v], text, &scene, error);
    }
    return ok;
}

static bool plan_sweeps(ChartPlan *plan, Error *error)
{
    const Args *args = plan->args;
    if (!chart_sweeps_take(args, &plan->sweeps, error))
        return false;
    for (int s = 0; s < args->sweep_count; s++)
        if (!sweep_check(plan, &args->sweeps[s], error))
            return false;
    plan->coarsening_count = chart_sweeps_spacings(args, plan->scene.world.spacing, plan->coarsenings, error);
    if (plan->coarsening_count == 0) {
        plan->coarsening_count = sizeof coarsenings / sizeof *coarsenings;
        memcpy(plan->coarsenings, coarsenings, sizeof coarsenings);
    }
    return plan->coarsening_count > 0;
}

/* Keeps notes on settings without effect only if they apply to each run. */
static void keep_common(Notes *notes, const Notes *other)
{
    int kept = 0;
    for (int i = 0; i < notes->count; i++) {
        if (i < notes->lasting && !notes_have(other, notes->line[i]))
            continue;
        if (kept != i)
            memcpy(notes->line[kept], notes->line[i], NOTE_SIZE);
        kept++;
    }
    notes->lasting -= notes->count - kept;
    notes->count = kept;
}

static void keep_notes_of_all(ChartPlan *plan)
{
    Scene scene;
    Notes notes;
    for (int i = 0; i < plan->count && plan->notes.lasting > 0; i++) {
        const ChartJob *job = &plan->jobs[i];
        Error error;
        RunSettings settings = {.all = *plan->subject.settings};
        settings.all.purpose = SCENE_FOR_CHART;
        if (job->role == CHART_POINT && job->coarsening == 1 &&
            run_settings_add(&settings, &error, "solver.method=%s", job->method) &&
            run_settings_add(&settings, &error, "solver.backend=%s", job->backend) &&
            scene_load(plan->subject.scene, &settings.all, &scene, &notes, &error))
            keep_common(&plan->notes, &notes);
    }
}

bool chart_plan_make(const Args *args, ChartPlan *plan, Error *error)
{
    *plan = (ChartPlan){.args = args};
    if (!chart_subject_find(args, &plan->subject, &plan->scene, &plan->notes, error) ||
        !plan_sweeps(plan, error) || !plan_jobs(plan, error))
        return false;
    keep_notes_of_all(plan);
    return plan->count > 0 || error_set(error, "slosh chart: nothing of it can run here");
}

/* Likeness of a row and a job: 3, same method and backend; 2, same backend; 1, any row with a time; 0,
   none. */
static int likeness(const ChartRow *row, const ChartJob *job)
{
    if (!(row->seconds > 0))
        return 0;
    return strcmp(row->backend, job->backend) != 0 ? 1 : strcmp(row->method, job->method) != 0 ? 2 : 3;
}

double chart_plan_seconds(const ChartPlan *plan, int i, const Trials *rows)
{
    const WorldDef *def = &plan->scene.world;
    double factor = 1, best = 0;
    for (int r = 0; r < rows->count; r++) {
        const ChartRow *row = trials_row(rows, r);
        const int like = likeness(row, &plan->jobs[i]);
        const double work =
            pow(row->spacing / def->spacing, -def->dimensions - 1) * (row->fineness > 0 ? 2 : 1);
        if (like < best || like == 0)
            continue;
        best = like; /* the last of the best rows: later rows are usually finer */
        factor = row->seconds / work;
    }
    return plan->work[i] * factor;
}
