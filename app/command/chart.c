#include "app/lab/chart.h"
#include "app/base/file.h"
#include "app/base/output.h"
#include "app/base/program.h"
#include "app/command/chart_views.h"
#include "app/command/cmd.h"
#include "app/lab/chart_plan.h"
#include "app/lab/chart_report.h"

#include <math.h>
#include <string.h>

/* Rows of the plan, in order, and all rows of the file, where runs of different settings stay. */
typedef struct Runs {
    ChartRows kept, rows;
    bool made[CHART_JOBS_MAX]; /* made by an older run */
    bool written;              /* --json is written */
    int there;                 /* count of the plan's rows with figures */
} Runs;

/* Makes the rows of the plan; takes figures of kept rows. */
static bool make_rows(const ChartPlan *plan, Runs *runs, Error *error)
{
    static Scene scene;
    ChartRows *rows = &runs->rows;
    rows->metric_count = plan->scene.metric_count;
    memcpy(rows->metrics, plan->scene.metrics, sizeof rows->metrics);
    rows->probe_count = plan->scene.probes.count;
    for (rows->count = 0; rows->count < plan->count; rows->count++) {
        const int i = rows->count;
        if (!chart_prepare(&plan->subject, &plan->jobs[i], &scene, &rows->row[i], NULL, error))
            return false;
        const ChartRow *old = chart_rows_find(&runs->kept, rows->row[i].key);
        runs->made[i] = old && old->outcome.kind != OUTCOME_NONE; /* other failures run again */
        runs->there += runs->made[i];
        if (runs->made[i])
            rows->row[i] = *old;
    }
    if (!plan->args->quiet && runs->there > 0)
        fprintf(stderr, "%d of %d runs %s in %s already\n", runs->there, plan->count,
                runs->there == 1 ? "is" : "are", plan->csv);
    return true;
}

/* Shares of the work to do: done before a job, and the job itself. */
static void shares(const ChartPlan *plan, const Runs *runs, int job, double *done, double *part)
{
    double all = 0;
    *done = *part = 0;
    for (int i = 0; i < plan->count; i++) {
        const double seconds = runs->made[i] ? 0 : chart_plan_seconds(plan, i, &runs->kept);
        all += seconds;
        *done += i < job ? seconds : 0;
        *part += i == job ? seconds : 0;
    }
    *done /= all;
    *part /= all;
}

static bool run_one(const ChartPlan *plan, Runs *runs, int job, Progress *progress, Error *error)
{
    double done, part;
    ChartRow *row = &runs->rows.row[job];
    shares(plan, runs, job, &done, &part);
    if (!chart_run(&plan->subject, &plan->jobs[job], row, progress, done, part, error))
        return false;
    runs->there++;
    chart_rows_add(&runs->kept, row, &runs->rows);
    chart_rows_merge(&runs->kept, plan->csv, &runs->rows);
    return chart_rows_write(&runs->kept, plan->csv, error);
}

/* Runs the missing jobs; writes the file after each job. */
static bool run_all(const ChartPlan *plan, Runs *runs, Error *error)
{
    Progress progress;
    bool ok = true;
    progress_begin(&progress, stderr, "chart", plan->args->quiet);
    for (int i = 0; ok && i < plan->count && !interrupted(); i++)
        ok = runs->made[i] || run_one(plan, runs, i, &progress, error);
    progress_end(&progress);
    return ok && !interrupted();
}

/* Updates the errors of kept rows; older runs of different settings stay in the file. */
static void keep_errors(ChartRows *kept, const ChartRows *rows)
{
    for (int i = 0; i < kept->count; i++) {
        const ChartRow *row = chart_rows_find(rows, kept->row[i].key);
        if (row)
            kept->row[i].error = row->error;
    }
}

/* Checks that the chart has at least one error value. */
static bool check_rows(const ChartPlan *plan, const ChartRows *rows, Error *error)
{
    int known = 0;
    const ChartRow *reference = chart_rows_reference(rows);
    if (reference && !chart_changes(rows, reference))
        return error_set(error, CHART_NO_CHANGE);
    if (!plan->subject.of && !reference)
        return error_set(error, "the finest run, which all are compared with, broke: no error is known; use "
                                "a smaller step or a larger spacing");
    for (int i = 0; i < rows->count; i++)
        known += rows->row[i].role == CHART_POINT && isfinite(rows->row[i].error);
    return known > 0 || error_set(error, "every run broke: no error is known; use a smaller step");
}

static bool finish(const ChartPlan *plan, Runs *runs, Error *error)
{
    char title[256], name[256 + sizeof "error: "];
    const Args *args = plan->args;
    const Case *of = plan->subject.of;
    ChartRows *rows = &runs->rows;
    const double floor = chart_rows_compare(rows);
    keep_errors(&runs->kept, rows);
    if (!args->quiet)
        chart_print(rows, floor, stdout);
    snprintf(title, sizeof title, "%.120s%s", of ? of->help : args->scenes[0],
             of ? "" : ": the finest run is the reference");
    chart_error_name(&plan->subject, &plan->scene, name + snprintf(name, sizeof name, "error: "));
    const ChartWords words = {title, name, plan->note};
    chart_rows_merge(&runs->kept, plan->csv, rows);
    const bool drawn = chart_rows_write(&runs->kept, plan->csv, error) &&
                       chart_draw(rows, &words, floor, args->output, error) && check_rows(plan, rows, error);
    if (!args->json)
        return drawn;
    Error no_json;
    runs->written = true;
    if (chart_write_json(rows, args->scenes[0], name + strlen("error: "), floor,
                         drawn ? NULL : error->message, args->json, &no_json))
        return drawn;
    *error = drawn ? no_json : *error;
    return false;
}

/* Writes JSON for a failure before all figures existed. */
static void write_failure(const ChartPlan *plan, const Runs *runs, const Error *error)
{
    const Args *args = plan->args;
    Error no_json;
    if (args->json && !runs->written && json_file_check(args->json, &no_json))
        failure_json_write(failure_json("chart", "scene", args->scenes[0], args->output, error), args->json);
}

static bool check_outputs(const ChartPlan *plan, ChartRows *kept, Error *error)
{
    const Args *args = plan->args;
    return chart_check(args->output, error) && output_check(args->output, error) &&
           output_check(plan->csv, error) && (!args->json || json_file_check(args->json, error)) &&
           chart_rows_read(kept, plan->csv, stderr, error);
}

/* Makes a context if a missing run is on a GPU. */
static bool make_context(ChartPlan *plan, const Runs *runs, Error *error)
{
    if (!plan->wants_context || runs->there == plan->count)
        return true;
    if (!plan->context && !(plan->context = headless_create(plan->args->gpu, error)))
        return false;
    fprintf(stderr, "renderer: %s\n", headless_renderer(plan->context));
    return true;
}

static int chart(ChartPlan *plan, Error *error)
{
    static Runs runs;
    notes_print(&plan->notes, stderr);
    if (*plan->note)
        fprintf(stderr, "%s\n", plan->note);
    const bool ok = check_outputs(plan, &runs.kept, error) && make_rows(plan, &runs, error) &&
                    make_context(plan, &runs, error) && run_all(plan, &runs, error) &&
                    finish(plan, &runs, error);
    if (interrupted()) {
        fprintf(stderr, "stopped after %d of %d runs; the same command goes on\n", runs.there, plan->count);
        return EXIT_INTERRUPTED;
    }
    if (ok)
        return 0;
    fprintf(stderr, "%s\n", error->message);
    write_failure(plan, &runs, error);
    return EXIT_FAILED;
}

int cmd_chart(const Args *args)
{
    static ChartPlan plan;
    Error error = {{0}};
    int code = EXIT_USAGE;
    interrupt_install();
    if (args->views)
        return chart_views(args);
    if (args->width > 0) {
        fprintf(stderr, "slosh chart: --size is of the pictures of --views; leave it out\n");
        return EXIT_USAGE;
    }
    if (chart_plan_make(args, &plan, &error))
        code = chart(&plan, &error);
    else
        fprintf(stderr, "%s\n", error.message);
    chart_plan_end(&plan);
    return code;
}
