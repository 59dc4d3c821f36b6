#include "app/bench/bench.h"

#include "app/base/file.h"
#include "app/bench/plot.h"
#include "app/run/measure/measure.h"

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

enum { WIDTH = 820, HEIGHT = 390 }; /* of the picture and of its panel, px */

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

static void put_curve(Plot *plot, const Curve *curve)
{
    for (size_t k = 0; k < curve->count; k++)
        if (isfinite(curve->at[k][0]) && isfinite(curve->at[k][1]))
            plot_point(plot, curve->at[k][0], curve->at[k][1]);
}

static bool has_points(const Curve *curve)
{
    for (size_t k = 0; k < curve->count; k++)
        if (isfinite(curve->at[k][0]) && isfinite(curve->at[k][1]))
            return true;
    return false;
}

/* Names a curve of a case: curve and method. */
static void curve_title(const CaseResult *result, int curve, char title[128])
{
    snprintf(title, 128, "%s, %s", result->of->plot.found[curve], result->scene.world.method);
}

static void put_found(const CaseResult *results, size_t count, Plot *plot)
{
    const CasePlot *of = &results[0].of->plot;
    int lines = 0;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < CASE_CURVES && of->found[c]; c++) {
            char title[128];
            curve_title(&results[i], c, title);
            lines += has_points(&results[i].run.found[c]);
            plot_series(plot, title, "with %s lt %d", of->dots ? "points pt 7 ps 0.5" : "lines lw 2", lines);
            put_curve(plot, &results[i].run.found[c]);
        }
}

static void put_expected(const CaseResult *result, Plot *plot)
{
    const CasePlot *of = &result->of->plot;
    for (int c = 0; c < CASE_CURVES && of->expected[c]; c++) {
        plot_series(plot, of->expected[c], "with %s lc '#2a3440'",
                    !of->points ? "lines lw 1.5 dt 2"
                    : c == 0    ? "points pt 6 ps 1 lw 2"
                                : "points pt 2 ps 0.7");
        put_curve(plot, &result->run.expected[c]);
    }
}

/* Widens the range around constant data: gnuplot warns about empty ranges. */
static void put_range(const CaseResult *results, size_t count, Plot *plot)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < CASE_CURVES; c++)
            for (size_t k = 0; k < results[i].run.found[c].count; k++) {
                low = fmin(low, results[i].run.found[c].at[k][1]);
                high = fmax(high, results[i].run.found[c].at[k][1]);
            }
    if (high >= low && high - low <= 1e-12)
        plot_axis(plot, "y", low - 1, high + 1, false);
}

static double legend_width(const CaseResult *results, size_t count)
{
    const CasePlot *of = &results[0].of->plot;
    double widest = 0;
    char title[128];
    for (int c = 0; c < CASE_CURVES && of->expected[c]; c++)
        widest = fmax(widest, plot_legend_width(of->expected[c]));
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < CASE_CURVES && of->found[c]; c++) {
            curve_title(&results[i], c, title);
            widest = fmax(widest, plot_legend_width(title));
        }
    return widest;
}

bool validate_plot(const CaseResult *results, size_t count, const char *path, Error *error)
{
    const Case *of = results[0].of;
    Plot plot = {.gnuplot = NULL};
    char title[256];
    const char *const titles[] = {title};
    const PlotPage page = {
        .width = WIDTH, .height = HEIGHT, .legend = legend_width(results, count), .lines = 2};
    snprintf(title, sizeof title, "%s: %zu particle%s", of->help, results[0].particles,
             plural(results[0].particles));
    if (!plot_begin_page(&plot, path, titles, 1, &page, error))
        return false;
    plot_set(&plot, "xlabel", of->plot.x, "");
    plot_set(&plot, "ylabel", of->plot.y, "");
    put_range(results, count, &plot);
    put_found(results, count, &plot);
    put_expected(&results[0], &plot);
    plot_draw(&plot, NULL);
    return plot_end(&plot, error);
}
