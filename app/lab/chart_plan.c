#include "app/lab/chart_plan.h"

#include "app/lab/chart.h"
#include "sim/gl/timer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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
    static Scene scene;
    static ChartRow row;
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
    if (settings.count == SCENE_SETTINGS_MAX)
        return error_set(error, "more than %d settings; write them into a scene file", SCENE_SETTINGS_MAX);
    settings.said[settings.count] = text;
    settings.set[settings.count++] = text + strlen("--sweep ");
    return subject->of ? case_scene(&setup, scene, error)
                       : scene_load(subject->scene, &settings, scene, NULL, error);
}

/* Finds the swept keys with an effect on a method; for the remaining keys one run is enough. */
static void find_effects(ChartPlan *plan, const char *method, bool effect[CHART_SWEEPS])
{
    static Scene scene;
    char text[96], why[NOTE_SIZE];
    Error error;
    snprintf(text, sizeof text, "--sweep solver.method=%s", method);
    const bool read = load_with(plan, method, text, &scene, &error);
    for (int k = 0; k < plan->sweeps.count; k++) {
        effect[k] = !read || chart_sweeps_effect(&plan->sweeps, k, &scene, why);
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
    bool effect[CHART_NAMES_MAX][CHART_SWEEPS];
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
    static Scene scene;
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
    static Scene scene;
    static Notes notes;
    for (int i = 0; i < plan->count && plan->notes.lasting > 0; i++) {
        const ChartJob *job = &plan->jobs[i];
        char method[96], backend[96];
        Error error;
        SceneSettings settings = *plan->subject.settings;
        if (job->role != CHART_POINT || job->coarsening != 1 || settings.count + 2 > SCENE_SETTINGS_MAX)
            continue;
        snprintf(method, sizeof method, "solver.method=%s", job->method);
        snprintf(backend, sizeof backend, "solver.backend=%s", job->backend);
        settings.set[settings.count++] = method;
        settings.set[settings.count++] = backend;
        settings.purpose = SCENE_FOR_CHART;
        if (scene_load(plan->subject.scene, &settings, &scene, &notes, &error))
            keep_common(&plan->notes, &notes);
    }
}

bool chart_plan_make(const Args *args, ChartPlan *plan, Error *error)
{
    *plan = (ChartPlan){.args = args};
    if (!chart_table_name(args->output, plan->csv, error) ||
        !chart_subject_find(args, &plan->subject, &plan->scene, &plan->notes, error))
        return false;
    if (!plan_sweeps(plan, error) || !plan_jobs(plan, error))
        return false;
    keep_notes_of_all(plan);
    return plan->count > 0 || error_set(error, "slosh chart: nothing of it can run here");
}

void chart_plan_end(ChartPlan *plan)
{
    headless_destroy(plan->context);
    plan->context = NULL;
}

/* Likeness of a row and a job: 3, same method and backend; 2, same backend; 1, any row with a time; 0,
   none. */
static int likeness(const ChartRow *row, const ChartJob *job)
{
    if (!(row->seconds > 0))
        return 0;
    return strcmp(row->backend, job->backend) != 0 ? 1 : strcmp(row->method, job->method) != 0 ? 2 : 3;
}

double chart_plan_seconds(const ChartPlan *plan, int i, const ChartRows *rows)
{
    const WorldDef *def = &plan->scene.world;
    double factor = 1, best = 0;
    for (int r = 0; r < rows->count; r++) {
        const ChartRow *row = &rows->row[r];
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
