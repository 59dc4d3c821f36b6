#include "app/bench/validate.h"

#include "app/base/file.h"
#include "app/bench/gnuplot.h"
#include "app/run/measure/outcome.h"

#include <math.h>

enum { LOOKS = 10 }; /* one look costs as much as a few steps */

CaseWatch case_watch_begin(const Case *of)
{
    return (CaseWatch){.every = 0.99 * of->time / LOOKS};
}

void case_watch(void *watcher, const WorldDef *def, World *world)
{
    CaseWatch *watch = watcher;
    WorldInfo info;
    world_info(world, &info);
    if (watch->looked && info.time < watch->next)
        return;
    watch->next = info.time + watch->every;
    watch->looked |= outcome_sample(&watch->history, def, false, world);
}

void case_watch_outcome(CaseWatch *watch, const CaseResult *result, Outcome *outcome)
{
    watch->history.trouble = result->run.info.trouble;
    if (!*result->failure || watch->history.trouble.ended)
        outcome_judge(&watch->history, outcome);
    else
        outcome_not_run(result->failure, outcome);
}

enum { WIDTH = 820, HEIGHT = 460 };

void validate_print_head(FILE *file)
{
    fprintf(file, "%-15s %-7s %-8s %-28s %11s %11s %9s %9s %8s\n", "case", "method", "backend", "metric",
            "value", "reference", "error", "tolerance", "seconds");
}

/* Formats a number with its unit, or a dash if not finite. */
static const char *cell(char out[32], const char *form, double number)
{
    if (!isfinite(number))
        return "-";
    snprintf(out, 32, form, number);
    return out;
}

/* Returns the known cause of a miss, or NULL. */
static const char *why_of(const CaseResult *result, int m)
{
    const CaseMethod *method = case_method(result->of, result->scene.world.method);
    return method && !case_passed(result, m) ? method->why[m] : NULL;
}

/* Prints the end of the line: why a figure did not pass, and the outcome of the run. */
static void print_miss(const CaseResult *result, const Outcome *outcome, int m, FILE *file)
{
    const char *why = why_of(result, m);
    const char *without = result->of->metrics[m].without;
    const bool judged = !result->of->metrics[m].no_verdict;
    if (judged && !isfinite(result->run.figures[m].error))
        fprintf(file, "  missed: %s", without && !*result->failure ? without : "no value");
    else if (!case_passed(result, m))
        fprintf(file, "  missed%s%s", why ? ": " : "", why ? why : "");
    if (outcome->kind > OUTCOME_HOLDS)
        fprintf(file, "  %s", outcome_word(outcome->kind));
    fputc('\n', file);
}

void validate_print(const CaseResult *result, const Outcome *outcome, FILE *file)
{
    const WorldDef *def = &result->scene.world;
    for (int m = 0; m < CASE_METRICS && result->of->metrics[m].name; m++) {
        const CaseMetric *metric = &result->of->metrics[m];
        const CaseFigure *figure = &result->run.figures[m];
        char value[32], reference[32], error[32], tolerance[32];
        fprintf(file, "%-15s %-7s %-8s %-28s %11s %11s %9s %9s %8.1f", result->of->name, def->method,
                def->backend, metric->name, cell(value, "%.5g", figure->value),
                cell(reference, "%.5g", figure->reference), cell(error, "%.3g %%", 100 * figure->error),
                cell(tolerance, "%.3g %%", 100 * case_tolerance(result->of, m, result->level, def->method)),
                result->seconds);
        print_miss(result, outcome, m, file);
    }
    if (outcome->kind > OUTCOME_HOLDS) {
        char text[OUTCOME_TEXT];
        fprintf(file, "  %s\n", outcome_text(outcome, text));
    }
    if (*result->failure)
        fprintf(file, "  %s\n", result->failure);
    fflush(file);
}

static json_t *figure_json(const CaseResult *result, const Outcome *outcome, int m)
{
    const CaseMetric *metric = &result->of->metrics[m];
    const CaseFigure *figure = &result->run.figures[m];
    const WorldDef *def = &result->scene.world;
    const double tolerance = case_tolerance(result->of, m, result->level, def->method);
    json_t *object =
        json_pack("{s:s, s:s, s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:f, s:I, s:s, s:s*, s:s*}", "case",
                  result->of->name, "metric", metric->name, "method", def->method, "backend", def->backend,
                  "value", number_json(figure->value), "reference", number_json(figure->reference), "error",
                  number_json(figure->error), "tolerance", number_json(tolerance), "passed",
                  isnan(tolerance) ? json_null() : json_boolean(case_passed(result, m)), "seconds",
                  result->seconds, "particles", (json_int_t)result->particles, "unit", metric->unit,
                  "failure", *result->failure ? result->failure : NULL, "why", why_of(result, m));
    outcome_json(object, outcome);
    return object;
}

bool validate_write_json(const CaseResult *results, const Outcome *outcomes, size_t count,
                         const char *failure, const char *path, Error *error)
{
    json_t *cases = json_array();
    bool ok = cases != NULL;
    for (size_t i = 0; i < count; i++)
        for (int m = 0; ok && m < CASE_METRICS && results[i].of->metrics[m].name; m++)
            ok = json_array_append_new(cases, figure_json(&results[i], &outcomes[i], m)) == 0;
    json_t *all = ok ? json_pack("{s:O, s:s*}", "cases", cases, "error", failure) : NULL;
    const bool written = json_file_write(all, path, error);
    json_decref(all);
    json_decref(cases);
    return written;
}

static void put_curve(FILE *gnuplot, const char *name, size_t i, int c, const Curve *curve)
{
    fprintf(gnuplot, "$%s%zu_%d << EOD\n", name, i, c);
    for (size_t k = 0; k < curve->count; k++)
        if (isfinite(curve->at[k][0]) && isfinite(curve->at[k][1]))
            fprintf(gnuplot, "%.9g %.9g\n", curve->at[k][0], curve->at[k][1]);
    fputs("EOD\n", gnuplot);
}

/* True if the curve has a finite point: gnuplot cannot plot an empty curve. */
static bool has_points(const Curve *curve)
{
    for (size_t k = 0; k < curve->count; k++)
        if (isfinite(curve->at[k][0]) && isfinite(curve->at[k][1]))
            return true;
    return false;
}

static int plot_found(const CaseResult *results, size_t count, FILE *gnuplot)
{
    const CasePlot *plot = &results[0].of->plot;
    int lines = 0;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < CASE_CURVES && plot->found[c]; c++) {
            char title[128];
            if (!has_points(&results[i].run.found[c]))
                continue;
            snprintf(title, sizeof title, "%s, %s", plot->found[c], results[i].scene.world.method);
            fprintf(gnuplot, "%s$found%zu_%d with %s lt %d title ", lines ? ", " : "plot ", i, c,
                    plot->dots ? "points pt 7 ps 0.3" : "lines lw 2", lines + 1);
            lines++;
            gnuplot_quote(gnuplot, title);
        }
    return lines;
}

/* Widens the range around constant data: gnuplot warns about empty ranges. */
static void put_range(const CaseResult *results, size_t count, FILE *gnuplot)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < CASE_CURVES; c++)
            for (size_t k = 0; k < results[i].run.found[c].count; k++) {
                low = fmin(low, results[i].run.found[c].at[k][1]);
                high = fmax(high, results[i].run.found[c].at[k][1]);
            }
    if (high >= low && high - low <= 1e-12)
        fprintf(gnuplot, "set yrange [%.9g:%.9g]\n", low - 1, high + 1);
}

static void plot_all(const CaseResult *results, size_t count, FILE *gnuplot)
{
    const CasePlot *plot = &results[0].of->plot;
    put_range(results, count, gnuplot);
    int lines = plot_found(results, count, gnuplot);
    for (int c = 0; c < CASE_CURVES && plot->expected[c]; c++) {
        if (!has_points(&results[0].run.expected[c]))
            continue;
        fprintf(gnuplot, "%s$expected0_%d with %s lc '#2a3440' title ", lines++ ? ", " : "plot ", c,
                !plot->points ? "lines lw 1.5 dt 2"
                : c == 0      ? "points pt 6 ps 1 lw 2"
                              : "points pt 2 ps 0.7");
        gnuplot_quote(gnuplot, plot->expected[c]);
    }
    fputs(lines ? "\n" : "plot 0 notitle\n", gnuplot);
}

bool validate_plot(const CaseResult *results, size_t count, const char *path, Error *error)
{
    const Case *of = results[0].of;
    Gnuplot chart = {.gnuplot = NULL};
    char title[256];
    if (!gnuplot_begin(&chart, path, WIDTH, HEIGHT, error))
        return false;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < CASE_CURVES; c++) {
            put_curve(chart.gnuplot, "found", i, c, &results[i].run.found[c]);
            put_curve(chart.gnuplot, "expected", i, c, &results[i].run.expected[c]);
        }
    snprintf(title, sizeof title, "%s: %zu particle%s", of->help, results[0].particles,
             plural(results[0].particles));
    fputs("set title ", chart.gnuplot);
    gnuplot_quote(chart.gnuplot, title);
    fputs("\nset xlabel ", chart.gnuplot);
    gnuplot_quote(chart.gnuplot, of->plot.x);
    fputs("\nset ylabel ", chart.gnuplot);
    gnuplot_quote(chart.gnuplot, of->plot.y);
    fputc('\n', chart.gnuplot);
    plot_all(results, count, chart.gnuplot);
    return gnuplot_end(&chart, error);
}
