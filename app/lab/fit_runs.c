#include "app/base/program.h"
#include "app/bench/bench.h"
#include "app/lab/fit.h"
#include "app/scene/scene.h"
#include "sim/step/method.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Times the scene's spacing. The finest stays well above the reference's 0.5. */
static const double spacings[] = {4, 3, 2.5, 2, 1.75, 1.5, 1.25, 1, 0.75};

/* Times the scene's step. */
static const double steps[] = {0.25, 0.5, 0.7, 1, 1.4, 2, 2.8, 4};

/* 2.1: as many neighbours as methods for play have; 2.6, 3, 3.5: supports of the measurements in three and
   in two dimensions. */
static const char *const supports[] = {NULL, "2.1", "2.6", "3", "3.5"};

/* Terms of a method, and kernels: they change error and cost, but not the flow. */
static const struct {
    const char *path, *value[4]; /* the first: NULL, the scene's own */
    bool inviscid;               /* only for scenes with inviscid fluid */
} terms[FIT_TERMS] = {
    {"solver.kernel", {NULL, "wendland_c2", "cubic"}, false},
    {"solver.delta_sph", {NULL, "0", "0.1"}, false},
    {"solver.shifting", {NULL, "0", "0.2"}, false},
    {"solver.corrected_gradient", {NULL, "false", "true"}, false},
    {"solver.artificial_viscosity", {NULL, "0", "0.02"}, true},
};

enum { SPACINGS = sizeof spacings / sizeof *spacings, STEPS = sizeof steps / sizeof *steps };

__attribute__((format(printf, 2, 3))) static void add(FitJob *job, const char *format, ...)
{
    va_list arguments;
    char *text = job->text[job->job.set_count];
    const int said = snprintf(text, sizeof job->text[0], "--sweep ");
    va_start(arguments, format);
    vsnprintf(text + said, sizeof job->text[0] - (size_t)said, format, arguments);
    va_end(arguments);
    job->job.set[job->job.set_count++] = text;
}

/* Starts a job with the scene's own spacing and step. */
static void start_job(const FitAxes *axes, const char *method, const char *preset, FitJob *job)
{
    *job = (FitJob){.job = {.role = CHART_POINT,
                            .method = method,
                            .backend = axes->scene->world.backend,
                            .coarsening = 1,
                            .step_unnamed = true}};
    if (preset)
        add(job, "solver.preset=%s", preset);
}

static bool load(const FitAxes *axes, const FitJob *job, Scene *scene, ChartRow *row)
{
    Error none;
    return chart_prepare(&axes->subject, &job->job, scene, row, NULL, &none);
}

/* True if equal as texts or as numbers: "0.1" equals "0.10". */
static bool same_value(const char *a, const char *b)
{
    char *end_a, *end_b;
    const double x = strtod(a, &end_a), y = strtod(b, &end_b);
    return strcmp(a, b) == 0 || (end_a != a && end_b != b && !*end_a && !*end_b && x == y);
}

/* True if the scene has the value already. */
static bool is_own(const Scene *scene, const char *path, const char *value)
{
    char now[128];
    key_value_text(scene_key_find(path), scene, now, sizeof now);
    return same_value(now, value);
}

/* Adds steps `factor` times as long as the steps of `scene`, loaded without this setting. Substeps per
   frame are whole numbers; with a single substep the frame itself gets longer. */
static void add_step(FitJob *job, const Scene *scene, double factor)
{
    const WorldDef *def = &scene->world;
    if (factor == 1)
        return;
    if (def->step_mode == STEP_CFL) {
        add(job, "solver.step.number=%.4g", def->cfl_number * factor);
        if (method_find(def->method)->incompressible) /* max_dt bounds the step of a slow fluid */
            add(job, "solver.step.max_dt=%.4g", def->max_dt * factor);
        return;
    }
    const double wanted = def->substeps / factor;
    const int substeps = wanted > 1 ? (int)lround(wanted) : 1;
    add(job, "solver.step.substeps=%d", substeps);
    if (wanted < 1)
        add(job, "solver.step.dt=%.4g", def->dt / wanted);
}

bool fit_axes_job(const FitAxes *axes, const FitPoint *point, FitJob *job)
{
    Scene scene;
    ChartRow row;
    const int *at = point->at, method = at[FIT_METHOD];
    start_job(axes, axes->method[method], axes->preset[at[FIT_PRESET]], job);
    if (!load(axes, job, &scene, &row))
        return true; /* chart_prepare reports the reason */
    if (at[FIT_SUPPORT] > 0) {
        if (is_own(&scene, "particles.support", supports[at[FIT_SUPPORT]]))
            return false;
        add(job, "particles.support=%s", supports[at[FIT_SUPPORT]]);
    }
    for (int t = 0; t < FIT_TERMS; t++) {
        const char *value = terms[t].value[at[FIT_TERM + t]];
        if (!value)
            continue;
        if (!axes->effect[method][t] || is_own(&scene, terms[t].path, value))
            return false;
        add(job, "%s=%s", terms[t].path, value);
    }
    add_step(job, &scene, steps[at[FIT_STEP]]);
    job->job.coarsening = spacings[at[FIT_SPACING]];
    return true;
}

/* Estimates the work: particles times steps times neighbours, in an arbitrary unit. */
static double fit_axes_work(const FitAxes *axes, const FitPoint *point)
{
    const WorldDef *def = &axes->scene->world;
    const char *support = supports[point->at[FIT_SUPPORT]];
    const double reach = support ? strtod(support, NULL) : def->support;
    return pow(spacings[point->at[FIT_SPACING]], -def->dimensions - 1) / steps[point->at[FIT_STEP]] *
           pow(reach, def->dimensions);
}

/* ---- values of the axes ---- */

static bool is_named(const Scene *scene, const char *method)
{
    return strcmp(scene->world.method, method) == 0;
}

/* Finds the methods able to run the scene, the scene's own first. */
static void find_methods(FitAxes *axes, Notes *notes)
{
    Scene scene;
    ChartRow row;
    const char *all[FIT_METHODS];
    int count = 0, *found = &axes->axis[FIT_METHOD].values;
    const Case *of = axes->subject.of;
    const char *only = chart_set_value(axes->subject.settings, "solver.method");
    if (only)
        all[count++] = only;
    for (const CaseMethod *at = of ? of->methods : NULL; !only && at && at->name && count < FIT_METHODS; at++)
        if (at->left_out)
            notes_add(notes, "left out: %s with %s, %s", of->name, at->name, at->left_out);
        else
            all[count++] = at->name;
    for (int i = 0; !only && !of && i < FIT_METHODS && world_methods()[i].name; i++)
        all[count++] = world_methods()[i].name;
    for (int own = 1; own >= 0; own--)
        for (int i = 0; i < count; i++) {
            FitJob job;
            Error why;
            if (is_named(axes->scene, all[i]) != own)
                continue;
            start_job(axes, all[i], NULL, &job);
            if (chart_prepare(&axes->subject, &job.job, &scene, &row, NULL, &why))
                axes->method[(*found)++] = all[i];
            else
                notes_add(notes, "left out: %s: %.300s", all[i], why.message);
        }
}

/* Finds the presets: the scene's own, and presets with other settings. The first preset of the list sets
   almost nothing. */
static void find_presets(FitAxes *axes)
{
    int *found = &axes->axis[FIT_PRESET].values;
    axes->preset[(*found)++] = NULL;
    if (chart_set_value(axes->subject.settings, "solver.preset"))
        return;
    for (const SolverPreset *preset = solver_preset_list; preset->name && *found < FIT_PRESETS; preset++)
        if (strcmp(preset->name, axes->scene->preset) != 0)
            axes->preset[(*found)++] = preset->name;
}

static bool has_inviscid(const WorldDef *def)
{
    for (int f = 0; f < def->fluid_count; f++)
        if (fluid_viscosity_most(&def->fluids[f]) == 0)
            return true;
    return false;
}

/* Finds the terms read by each method. */
static void find_effects(FitAxes *axes)
{
    Scene scene;
    ChartRow row;
    char why[NOTE_SIZE];
    for (int m = 0; m < axes->axis[FIT_METHOD].values; m++) {
        FitJob job;
        start_job(axes, axes->method[m], NULL, &job);
        const bool read = load(axes, &job, &scene, &row);
        scene.purpose = SCENE_FOR_CHART;
        for (int t = 0; t < FIT_TERMS; t++)
            axes->effect[m][t] = read && key_has_effect(&scene, terms[t].path, why) &&
                                 (!terms[t].inviscid || has_inviscid(&scene.world));
    }
}

static int place_of(const double list[], int count, double wanted)
{
    for (int i = 0; i < count; i++)
        if (list[i] == wanted)
            return i;
    return 0;
}

void fit_axes_make(const ChartSubject *subject, const Scene *scene, FitAxes *axes, Notes *notes)
{
    *axes = (FitAxes){.subject = *subject, .scene = scene, .axes = FIT_TERM + FIT_TERMS};
    _Static_assert(FIT_TERM + FIT_TERMS <= FIT_AXES && (int)SPACINGS <= (int)FIT_VALUES, "room for all");
    axes->axis[FIT_METHOD].kind = axes->axis[FIT_PRESET].kind = FIT_LINE;
    axes->axis[FIT_SPACING] = (FitAxis){FIT_LADDER, SPACINGS, place_of(spacings, SPACINGS, 1)};
    axes->axis[FIT_STEP] = (FitAxis){FIT_ORDERED, STEPS, place_of(steps, STEPS, 1)};
    axes->axis[FIT_SUPPORT] = (FitAxis){FIT_FREE, sizeof supports / sizeof *supports, 0};
    if (chart_set_value(axes->subject.settings, "particles.support"))
        axes->axis[FIT_SUPPORT].values = 1;
    for (int t = 0; t < FIT_TERMS; t++) {
        FitAxis *axis = &axes->axis[FIT_TERM + t];
        *axis = (FitAxis){FIT_FREE, 1, 0};
        while (!chart_set_value(axes->subject.settings, terms[t].path) && terms[t].value[axis->values])
            axis->values++;
    }
    find_methods(axes, notes);
    find_presets(axes);
    find_effects(axes);
}

/* Jitters of the repeats of a run, spacings. */
static const double jitters[] = {1e-6, 2e-6, 3e-6};
enum { REPEATS = sizeof jitters / sizeof *jitters };

/* Of the reference: times the scene's spacing, and times its step. */
static const double FINEST = 0.5;

static FitPoint own_point(const FitAxes *axes)
{
    FitPoint point = {{0}};
    for (int x = 0; x < axes->axes; x++)
        point.at[x] = axes->axis[x].own;
    return point;
}

static void reference_job(const FitAxes *axes, FitJob *job)
{
    const FitPoint own = own_point(axes);
    fit_axes_job(axes, &own, job);
    job->job.role = CHART_REFERENCE;
    job->job.coarsening = FINEST;
    job->job.fineness = 1;
}

/* Checks, before any run, that the reference can be loaded. */
static bool check_reference(const FitAxes *axes, Error *error)
{
    Scene scene;
    ChartRow row;
    FitJob job;
    Error why;
    reference_job(axes, &job);
    return axes->subject.of || chart_prepare(&axes->subject, &job.job, &scene, &row, NULL, &why) ||
           error_set(error,
                     "the run at half the spacing, which all are compared with, cannot be made: %.700s",
                     why.message);
}

/* Collects the notes on the unchanged scene. */
static bool note_own(FitRuns *runs, Error *error)
{
    Scene scene;
    ChartRow row;
    const FitPoint own = own_point(runs->axes);
    FitJob job;
    fit_axes_job(runs->axes, &own, &job);
    return chart_prepare(&runs->axes->subject, &job.job, &scene, &row, &runs->own, error);
}

bool fit_runs_begin(const FitAxes *axes, ExperimentRun *run, FitRuns *runs, Error *error)
{
    *runs = (FitRuns){.axes = axes, .run = run, .quiet = run->args->quiet, .floor = (double)NAN};
    runs->used = chart_rows_of(&run->rows, axes->scene);
    return check_reference(axes, error) && note_own(runs, error);
}

/* Runs shorter than SHORT, s, are timed TIMINGS times in total, and the least time counts: otherwise
   another program or the start of threads would distort the time. */
static const double SHORT = 0.3;
enum { TIMINGS = 3 };

/* Makes a run. Shows a progress bar only on a terminal; elsewhere the lines of the runs show the progress. */
static bool run(FitRuns *runs, const ChartJob *job, ChartRow *row)
{
    Progress progress;
    char what[96];
    double least = INFINITY;
    const double time = runs->axes->subject.of ? runs->axes->subject.of->time : runs->axes->subject.time;
    snprintf(what, sizeof what, "%.20s at %.4g m", row->method, row->spacing);
    progress_begin(&progress, stderr, what, runs->quiet || !isatty(STDERR_FILENO));
    bool ok = true, again = true;
    for (int i = 0; ok && again && i < TIMINGS; i++) {
        const ProgressPart part = {&progress, (double)i / TIMINGS, 1.0 / TIMINGS};
        ok = chart_run(&runs->axes->subject, job, row, &part, &runs->error) && !interrupted();
        again = job->role == CHART_POINT && row->seconds * time < SHORT; /* false for a broken run (NaN) */
        least = fmin(least, row->seconds);
    }
    progress_end(&progress);
    row->seconds = isfinite(row->seconds) ? least : row->seconds;
    return ok;
}

int fit_threads(const Scene *scene)
{
    const int asked = *world_threads(&scene->world);
    return asked > 0 ? asked : world_processors();
}

/* Prepares a row. Its key includes the machine: times of another machine are not reused. */
static bool prepare(const FitRuns *runs, const ChartJob *job, ChartRow *row, Notes *notes, Error *error)
{
    Scene scene;
    char machine[256];
    if (!chart_prepare(&runs->axes->subject, job, &scene, row, notes, error))
        return false;
    snprintf(machine, sizeof machine, "%d %s", fit_threads(&scene), bench_processor());
    row->key = run_key_text(row->key, machine);
    return true;
}

/* Fills in the row of a job, from the file if there is an older run. */
static bool row_of(FitRuns *runs, const ChartJob *job, ChartRow *row)
{
    if (!prepare(runs, job, row, NULL, &runs->error))
        return false;
    const ChartRow *old = trials_find(&runs->run->file, row->key);
    const bool there = old && old->outcome.kind != OUTCOME_NONE; /* no fault of the fluid: run again */
    if (there)
        *row = *old;
    else if (!run(runs, job, row))
        return false;
    runs->there += there;
    runs->made += !there;
    if (!trials_add(&runs->run->rows, row, &runs->run->rows))
        return error_set(&runs->error,
                         "more than %d runs, which is all there is room for; fix some keys by --set, or "
                         "--method, and search the rest",
                         CHART_ROWS_MAX);
    return there || experiment_keep(runs->run, row, &runs->error);
}

/* Error of a row: for a scene the distance from the reference, for a case its own. */
static double error_of(const FitRuns *runs, const ChartRow *row)
{
    if (runs->axes->subject.of || !isfinite(row->seconds))
        return row->error;
    return chart_distance(&runs->used, row, &runs->reference);
}

/* Distance between two runs; for a case the difference of errors. NaN: a run broke. */
static double apart(const FitRuns *runs, const ChartRow *a, const ChartRow *b)
{
    if (!isfinite(a->seconds) || !isfinite(b->seconds))
        return (double)NAN;
    return runs->axes->subject.of ? fabs(a->error - b->error) : chart_distance(&runs->used, a, b);
}

/* Fails if no metric changes in the row; a broken run passes. */
static bool check_changes(FitRuns *runs, const ChartRow *row)
{
    return runs->axes->subject.of || !isfinite(row->seconds) || chart_changes(&runs->used, row) ||
           error_set(&runs->error, CHART_NO_CHANGE);
}

bool fit_runs_floor(FitRuns *runs)
{
    ChartRow row[REPEATS];
    const FitPoint own = own_point(runs->axes);
    FitJob job;
    fit_axes_job(runs->axes, &own, &job);
    job.job.role = CHART_FLOOR;
    for (int i = 0; i < REPEATS; i++) {
        job.job.jitter = jitters[i];
        if (!row_of(runs, &job.job, &row[i]))
            return false;
        for (int k = 0; k < i; k++)
            runs->floor = fmax(runs->floor, apart(runs, &row[i], &row[k])); /* fmax skips NaN */
    }
    return check_changes(runs, &row[0]);
}

bool fit_runs_reference(FitRuns *runs)
{
    if (runs->axes->subject.of)
        return true;
    FitJob job;
    reference_job(runs->axes, &job);
    if (!row_of(runs, &job.job, &runs->reference))
        return false;
    if (!isfinite(runs->reference.seconds))
        return error_set(&runs->error,
                         "the finest run, which all are compared with, broke (%s): no error is "
                         "known; use a smaller step or a larger spacing",
                         runs->reference.outcome.words);
    return check_changes(runs, &runs->reference);
}

/* ---- callbacks of the search ---- */

static double work(void *of, const FitPoint *point)
{
    return fit_axes_work(((const FitRuns *)of)->axes, point);
}

/* Prints each reason once. */
static void say_left_out(FitRuns *runs, const char *why)
{
    const uint64_t reason = run_key_text(RUN_KEY, why);
    for (int i = 0; i < runs->left_count; i++)
        if (runs->left_out[i] == reason)
            return;
    if (runs->left_count < FIT_REASONS)
        runs->left_out[runs->left_count++] = reason;
    if (!runs->quiet)
        fprintf(stderr, "left out: %s\n", why);
}

/* True if two lines are equal, or, unless `exactly`, equal apart from numbers. */
static bool same_line(const char *a, const char *b, bool exactly)
{
    static const char NUMBER[] = "0123456789.";
    for (; *a || *b; a++, b++) {
        a += exactly ? 0 : strspn(a, NUMBER);
        b += exactly ? 0 : strspn(b, NUMBER);
        if (*a != *b)
            return false;
        if (!*a)
            return true;
    }
    return true;
}

static bool is_said(const Notes *notes, const char *line, bool exactly)
{
    for (int i = 0; i < notes->count; i++)
        if (same_line(notes->line[i], line, exactly))
            return true;
    return false;
}

/* True if the setting has a note that the unchanged scene does not have. Ignores notes on settings without
   effect: the written scene leaves such settings out. If the unchanged scene breaks, its note may be the
   reason, so only exactly equal notes are ignored. */
static bool is_warned(FitRuns *runs, const Notes *notes)
{
    for (int i = notes->lasting; i < notes->count; i++) {
        if (is_said(&runs->own, notes->line[i], !isfinite(runs->floor)))
            continue;
        if (runs->warned++ == 0)
            snprintf(runs->warning, sizeof runs->warning, "%s", notes->line[i]);
        return true;
    }
    return false;
}

/* Returns false also if another setting gives the same scene, by naming an existing value. */
static bool exists(void *of, const FitPoint *point)
{
    ChartRow row;
    Notes notes = {.count = 0};
    FitRuns *runs = of;
    FitJob job;
    Error why;
    if (!fit_axes_job(runs->axes, point, &job))
        return false;
    if (prepare(runs, &job.job, &row, &notes, &why))
        return !trials_find(&runs->run->rows, row.key) && !is_warned(runs, &notes);
    say_left_out(runs, why.message);
    return false;
}

static void say(const FitRuns *runs, const ChartRow *row)
{
    if (runs->quiet)
        return;
    fprintf(stderr, "%s, %s, spacing %.4g m%s%s: ", row->method, row->step, row->spacing,
            *row->swept ? ", " : "", row->swept);
    if (isfinite(row->error))
        fprintf(stderr, "error %.3g %%, ", 100 * row->error);
    if (isfinite(row->seconds))
        fprintf(stderr, "%.3g s a simulated second, ", row->seconds);
    fprintf(stderr, "%s\n", outcome_word(row->outcome.kind));
}

/* True if the run holds without help: after going back, the sentinel runs with other steps than set. */
static bool holds(const ChartRow *row)
{
    return row->outcome.kind == OUTCOME_HOLDS && row->backs == 0;
}

static bool make(void *of, const FitPoint *point, double predicted, FitFigures *figures)
{
    ChartRow row;
    FitRuns *runs = of;
    FitJob job;
    (void)predicted;
    if (!fit_axes_job(runs->axes, point, &job) || !row_of(runs, &job.job, &row))
        return false;
    row.error = error_of(runs, &row);
    trials_add(&runs->run->rows, &row, NULL);
    *figures = (FitFigures){.cost = row.seconds,
                            .error = row.error,
                            .holds = holds(&row),
                            .row = trials_place(&runs->run->rows, row.key)};
    say(runs, &row);
    return true;
}

/* Repeats a run with small jitters; and once three times as long. */
static bool repeat(void *of, const FitPoint *point, const FitFigures *figures, double *worst, bool *all_hold)
{
    ChartRow row;
    FitRuns *runs = of;
    FitJob job;
    fit_axes_job(runs->axes, point, &job);
    job.job.role = CHART_FLOOR;
    *worst = figures->error;
    *all_hold = true;
    for (int i = 0; i < REPEATS; i++) {
        job.job.jitter = jitters[i];
        if (!row_of(runs, &job.job, &row))
            return false;
        *worst = fmax(*worst, error_of(runs, &row));
        *all_hold &= holds(&row);
    }
    if (!*all_hold)
        return true;
    job.job.role = CHART_LONG;
    job.job.jitter = 0;
    if (!row_of(runs, &job.job, &row))
        return false;
    *all_hold = holds(&row);
    return true;
}

void fit_runs_space(FitRuns *runs, FitSpace *space)
{
    const FitAxes *axes = runs->axes;
    *space = (FitSpace){.axes = axes->axes,
                        .scatter = fmax(runs->floor, 0),
                        .power = axes->scene->world.dimensions + 1,
                        .exists = exists,
                        .work = work,
                        .run = make,
                        .repeat = repeat,
                        .of = runs};
    memcpy(space->axis, axes->axis, sizeof space->axis);
}
