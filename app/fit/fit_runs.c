#include "app/fit/fit_runs.h"

#include "app/base/program.h"
#include "app/lab/bench.h"
#include "app/lab/run_key.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

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
    static Scene scene;
    static ChartRow row;
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
    static Scene scene;
    static ChartRow row;
    const FitPoint own = own_point(runs->axes);
    FitJob job;
    fit_axes_job(runs->axes, &own, &job);
    return chart_prepare(&runs->axes->subject, &job.job, &scene, &row, &runs->own, error);
}

bool fit_runs_begin(const FitAxes *axes, const char *csv, bool quiet, FitRuns *runs, Error *error)
{
    *runs = (FitRuns){.axes = axes, .csv = csv, .quiet = quiet, .floor = (double)NAN};
    const Scene *scene = axes->scene;
    runs->used.metric_count = scene->metric_count;
    memcpy(runs->used.metrics, scene->metrics, sizeof runs->used.metrics);
    runs->used.probe_count = scene->probes.count;
    return chart_rows_read(&runs->kept, csv, stderr, error) && check_reference(axes, error) &&
           note_own(runs, error);
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
        ok = chart_run(&runs->axes->subject, job, row, &progress, (double)i / TIMINGS, 1.0 / TIMINGS,
                       &runs->error) &&
             !interrupted();
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
    static Scene scene;
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
    const ChartRow *old = chart_rows_find(&runs->kept, row->key);
    const bool there = old && old->outcome.kind != OUTCOME_NONE; /* no fault of the fluid: run again */
    if (there)
        *row = *old;
    else if (!run(runs, job, row))
        return false;
    runs->there += there;
    runs->made += !there;
    chart_rows_add(&runs->used, row, &runs->used);
    if (!chart_rows_find(&runs->used, row->key))
        return error_set(&runs->error,
                         "more than %d runs, which is all there is room for; fix some keys by --set, or "
                         "--method, and search the rest",
                         CHART_ROWS_MAX);
    if (there)
        return true;
    chart_rows_add(&runs->kept, row, &runs->used);
    chart_rows_merge(&runs->kept, runs->csv, &runs->used);
    return chart_rows_write(&runs->kept, runs->csv, &runs->error);
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
    static ChartRow row[REPEATS];
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
    static ChartRow row;
    static Notes notes;
    FitRuns *runs = of;
    FitJob job;
    Error why;
    if (!fit_axes_job(runs->axes, point, &job))
        return false;
    notes = (Notes){.count = 0};
    if (prepare(runs, &job.job, &row, &notes, &why))
        return !chart_rows_find(&runs->used, row.key) && !is_warned(runs, &notes);
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
    static ChartRow row;
    FitRuns *runs = of;
    FitJob job;
    (void)predicted;
    if (!fit_axes_job(runs->axes, point, &job) || !row_of(runs, &job.job, &row))
        return false;
    row.error = error_of(runs, &row);
    chart_rows_add(&runs->used, &row, &runs->used);
    *figures = (FitFigures){.cost = row.seconds,
                            .error = row.error,
                            .holds = holds(&row),
                            .row = (int)(chart_rows_find(&runs->used, row.key) - runs->used.row)};
    say(runs, &row);
    return true;
}

/* Repeats a run with small jitters; and once three times as long. */
static bool repeat(void *of, const FitPoint *point, const FitFigures *figures, double *worst, bool *all_hold)
{
    static ChartRow row;
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
