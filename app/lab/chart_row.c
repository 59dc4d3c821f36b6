#include "app/base/file.h"
#include "app/lab/error_chart.h"
#include "app/run/measure/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Parses "1 2 3"; returns the count of numbers, or -1. */
static int parse_numbers(char *text, double numbers[CHART_QUANTITIES])
{
    int read = 0;
    for (char *cell = strsep(&text, " "), *end; cell; cell = strsep(&text, " "), read++) {
        if (read == CHART_QUANTITIES)
            return -1;
        numbers[read] = strtod(cell, &end);
        if (end == cell || *end)
            return -1;
    }
    return read;
}

/* Parses "1 2 3;1.1 2 3;...": CHART_TIMES times with equal counts of numbers; or nothing, for a case. */
static bool parse_series(char *text, void *of)
{
    ChartRow *row = of;
    int times = 0;
    if (!*text)
        return true;
    for (char *cell = strsep(&text, ";"); cell; cell = strsep(&text, ";"), times++) {
        const int numbers = times < CHART_TIMES ? parse_numbers(cell, row->series[times]) : -1;
        if (numbers < 1 || (times > 0 && numbers != row->quantities))
            return false;
        row->quantities = numbers;
    }
    return times == CHART_TIMES;
}

/* Prints the series with all bits: a resumed chart has the same errors. */
static void print_series(const void *of, FILE *file)
{
    const ChartRow *row = of;
    for (int t = 0; t < CHART_TIMES && row->quantities > 0; t++)
        for (int q = 0; q < row->quantities; q++)
            fprintf(file, "%s%.17g", q ? " " : t ? ";" : "", row->series[t][q]);
}

static const char *const roles[] = {"point", "reference", "floor", "long", NULL};

/* Valid: NaN seconds of a broken run, NaN error without a reference. */
static const TrialColumn columns[] = {
    {"role", CELL_WORD, CELL(ChartRow, role), .words = roles},
    {"method", CELL_TEXT, CELL(ChartRow, method)},
    {"backend", CELL_TEXT, CELL(ChartRow, backend)},
    {"step", CELL_TEXT, CELL(ChartRow, step)},
    {"fineness", CELL_INTEGER, CELL(ChartRow, fineness), .most = 99},
    {"spacing_m", CELL_NUMBER, CELL(ChartRow, spacing), .flags = CELL_OPEN, .digits = 9},
    {"particles", CELL_INTEGER, CELL(ChartRow, particles), .most = 1e15},
    {"seconds_a_simulated_second", CELL_NUMBER, CELL(ChartRow, seconds), .flags = CELL_OPEN | CELL_NAN,
     .digits = 12},
    {"error", CELL_NUMBER, CELL(ChartRow, error), .flags = CELL_NAN, .digits = 6},
    {"outcome", CELL_OUTCOME, CELL(ChartRow, outcome)},
    {"backs", CELL_INTEGER, CELL(ChartRow, backs), .most = 1e9},
    {"swept", CELL_TEXT, CELL(ChartRow, swept), .flags = CELL_EMPTY},
    {"series", CELL_OWN, .print = print_series, .parse = parse_series},
    {NULL},
};

const TrialTable chart_table = {
    .who = "a chart",
    .result = "chart",
    .trial = "run",
    .head = "key,role,method,backend,step,fineness,spacing_m,particles,seconds_a_simulated_second,error,"
            "outcome,outcome_s,outcome_words,backs,swept,series\n",
    .opening = "key,role,method,backend,",
    .row_size = sizeof(ChartRow),
    .most = CHART_ROWS_MAX,
    .columns = columns,
};

ChartRows chart_rows_of(Trials *trials, const Scene *scene)
{
    ChartRows rows = {
        .metric_count = scene->metric_count, .probe_count = scene->probes.count, .trials = trials};
    memcpy(rows.metrics, scene->metrics, sizeof rows.metrics);
    return rows;
}

const ChartRow *chart_rows_reference(const ChartRows *rows)
{
    for (int i = 0; i < rows->trials->count; i++)
        if (chart_row(rows, i)->role == CHART_REFERENCE && isfinite(chart_row(rows, i)->seconds))
            return chart_row(rows, i);
    return NULL;
}

/* Distance over the numbers of one metric: rms distance over the greatest range of a single number.
   Returns false without a range: a constant in the reference has no scale. */
static bool distance_of(const ChartRow *row, const ChartRow *reference, int first, int count,
                        double *distance)
{
    double sum2 = 0, range = 0;
    int times = 0;
    for (int q = first; q < first + count; q++) {
        double low = INFINITY, high = -INFINITY;
        for (int t = 0; t < CHART_TIMES; t++) {
            const double off = row->series[t][q] - reference->series[t][q];
            sum2 += isfinite(off) ? off * off : 0;
            times += isfinite(off);
            low = fmin(low, reference->series[t][q]); /* fmin skips NaN */
            high = fmax(high, reference->series[t][q]);
        }
        range = fmax(range, high - low);
    }
    *distance = times > 0 ? sqrt(sum2 * count / times) / range : (double)NAN;
    return times == 0 || range > 0;
}

/* Distance of one metric of `numbers` numbers; if `apart`, the mean over the numbers with a range. */
static bool metric_distance(const ChartRow *row, const ChartRow *reference, int first, int numbers,
                            bool apart, double *distance)
{
    double sum = 0;
    int compared = 0;
    if (!apart)
        return distance_of(row, reference, first, numbers, distance);
    for (int q = first; q < first + numbers; q++)
        if (distance_of(row, reference, q, 1, distance) && !isnan(*distance)) {
            sum += *distance;
            compared++;
        }
    *distance = sum / compared;
    return compared > 0;
}

double chart_distance(const ChartRows *rows, const ChartRow *row, const ChartRow *reference)
{
    double sum = 0, distance;
    int compared = 0, first = 0;
    for (int m = 0; m < rows->metric_count; m++) {
        const int numbers = metric_numbers(rows->metrics[m], rows->probe_count);
        const bool apart = metric_kinds[rows->metrics[m]].numbers == 0;
        if (metric_distance(row, reference, first, numbers, apart, &distance)) {
            sum += distance;
            compared++;
        }
        first += numbers;
    }
    if (row->quantities < first || reference->quantities < first)
        return (double)NAN;
    return compared > 0 ? sum / compared : (double)NAN;
}

bool chart_changes(const ChartRows *rows, const ChartRow *row)
{
    return !isnan(chart_distance(rows, row, row));
}

static bool is_floor(const ChartRow *row)
{
    return row->role == CHART_FLOOR && isfinite(row->seconds);
}

double chart_rows_compare(ChartRows *rows)
{
    const ChartRow *reference = chart_rows_reference(rows);
    double floor = (double)NAN;
    for (int i = 0; i < rows->trials->count; i++) {
        ChartRow *row = chart_row(rows, i);
        if (reference)
            row->error = isfinite(row->seconds) ? chart_distance(rows, row, reference) : (double)NAN;
        for (int k = 0; k < i && is_floor(row); k++)
            if (is_floor(chart_row(rows, k))) /* fmax skips NaN */
                floor = fmax(floor, chart_distance(rows, row, chart_row(rows, k)));
    }
    return floor;
}

bool chart_on_front(const ChartRows *rows, int row)
{
    const ChartRow *mine = chart_row(rows, row);
    if (mine->role != CHART_POINT || !isfinite(mine->error) || !isfinite(mine->seconds))
        return false;
    for (int i = 0; i < rows->trials->count; i++) {
        const ChartRow *other = chart_row(rows, i);
        if (i != row && other->role == CHART_POINT && other->seconds <= mine->seconds &&
            other->error <= mine->error && (other->seconds < mine->seconds || other->error < mine->error))
            return false;
    }
    return true;
}

bool chart_drawn(const ChartRow *row)
{
    return row->role == CHART_POINT && isfinite(row->seconds) && row->error > 0 && isfinite(row->error);
}

bool chart_same_line(const ChartRow *a, const ChartRow *b)
{
    return strcmp(a->method, b->method) == 0 && strcmp(a->backend, b->backend) == 0 &&
           strcmp(a->swept, b->swept) == 0 && a->fineness == b->fineness;
}

bool chart_opens_line(const ChartRows *rows, int row)
{
    for (int i = 0; i < row; i++)
        if (chart_drawn(chart_row(rows, i)) && chart_same_line(chart_row(rows, i), chart_row(rows, row)))
            return false;
    return chart_drawn(chart_row(rows, row));
}

void chart_line_name(const ChartRow *row, char name[CHART_NAME])
{
    snprintf(name, CHART_NAME, "%s, %s%s%s, %s steps", row->method, row->backend, *row->swept ? ", " : "",
             row->swept, row->fineness ? "fine" : "long");
}

/* True if each finer run of the line is more accurate than each coarser run. */
static bool falls(const ChartRows *rows, int first)
{
    const ChartRow *opener = chart_row(rows, first);
    for (int i = first; i < rows->trials->count; i++)
        for (int k = first; k < rows->trials->count; k++) {
            const ChartRow *a = chart_row(rows, i), *b = chart_row(rows, k);
            if (chart_drawn(a) && chart_drawn(b) && chart_same_line(a, opener) &&
                chart_same_line(b, opener) && a->spacing < b->spacing && a->error >= b->error)
                return false;
        }
    return true;
}

double chart_order(const ChartRows *rows, int first, double floor, const char **why)
{
    Curve line = {.count = 0};
    bool known = true;
    for (int i = first; i < rows->trials->count; i++) {
        const ChartRow *row = chart_row(rows, i);
        if (!chart_drawn(row) || !chart_same_line(row, chart_row(rows, first)))
            continue;
        known &= !(row->error <= floor);
        curve_add(&line, log(row->spacing), log(row->error));
    }
    *why = line.count < 3        ? "fewer than three runs"
           : !known              ? "errors reach the spread"
           : !falls(rows, first) ? "errors do not fall"
                                 : NULL;
    const double order = *why ? (double)NAN : curve_slope(&line);
    curve_free(&line);
    return order;
}

static const char *remark(const ChartRows *rows, int i)
{
    const ChartRow *row = chart_row(rows, i);
    if (row->role == CHART_REFERENCE)
        return "  the reference";
    return chart_on_front(rows, i) ? "  best for its time" : "";
}

static void print_orders(const ChartRows *rows, double floor, FILE *file)
{
    for (int i = 0; i < rows->trials->count; i++) {
        char name[CHART_NAME];
        const char *why;
        if (!chart_opens_line(rows, i))
            continue;
        chart_line_name(chart_row(rows, i), name);
        const double order = chart_order(rows, i, floor, &why);
        if (why)
            fprintf(file, "%s: no order over the spacing: %s\n", name, why);
        else
            fprintf(file, "%s: order %.2f over the spacing\n", name, order);
    }
}

void chart_print(const ChartRows *rows, double floor, FILE *file)
{
    fprintf(file, "%-8s %-8s %-12s %10s %9s %14s %9s\n", "method", "backend", "step", "spacing, m",
            "particles", "s a simulated s", "error");
    for (int i = 0; i < rows->trials->count; i++) {
        const ChartRow *row = chart_row(rows, i);
        char text[OUTCOME_TEXT];
        if (row->role == CHART_FLOOR)
            continue;
        fprintf(file, "%-8s %-8s %-12s %10.4g %9zu %14.4g %7.3g %%%s%s%s\n", row->method, row->backend,
                row->step, row->spacing, row->particles, row->seconds, 100 * row->error,
                *row->swept ? "  " : "", row->swept, remark(rows, i));
        if (row->outcome.kind != OUTCOME_HOLDS)
            fprintf(file, "  %s\n", outcome_text(&row->outcome, text));
    }
    print_orders(rows, floor, file);
    if (isfinite(floor))
        fprintf(file, "three runs that differ by 1e-6 of a spacing: %.3g %% apart\n", 100 * floor);
}

static json_t *row_json(const ChartRows *rows, int i)
{
    const ChartRow *row = chart_row(rows, i);
    json_t *json =
        json_pack("{s:s, s:s, s:s, s:s, s:f, s:I, s:o, s:o, s:b}", "role", roles[row->role], "method",
                  row->method, "backend", row->backend, "step", row->step, "spacing", row->spacing,
                  "particles", (json_int_t)row->particles, "seconds_per_second", number_json(row->seconds),
                  "error", number_json(row->error), "front", chart_on_front(rows, i));
    outcome_json(json, &row->outcome);
    if (json && *row->swept)
        json_object_set_new(json, "swept", json_string(row->swept));
    return json;
}

/* Returns one entry per line of the convergence. */
static json_t *orders_json(const ChartRows *rows, double floor)
{
    json_t *orders = json_array();
    for (int i = 0; i < rows->trials->count; i++) {
        const ChartRow *row = chart_row(rows, i);
        const char *why;
        if (!chart_opens_line(rows, i))
            continue;
        const double order = chart_order(rows, i, floor, &why);
        json_array_append_new(orders, json_pack("{s:s, s:s, s:s, s:o, s:s?, s:s*}", "method", row->method,
                                                "backend", row->backend, "steps",
                                                row->fineness ? "fine" : "long", "order", number_json(order),
                                                "why", why, "swept", *row->swept ? row->swept : NULL));
    }
    return orders;
}

json_t *chart_json(const ChartRows *rows, const char *subject, const char *error_name, double floor,
                   const char *failure)
{
    json_t *runs = json_array();
    for (int i = 0; i < rows->trials->count; i++)
        json_array_append_new(runs, row_json(rows, i));
    return json_pack("{s:s, s:s, s:o, s:o, s:o, s:s*}", "chart", subject, "error_of", error_name, "floor",
                     number_json(floor), "orders", orders_json(rows, floor), "runs", runs, "error", failure);
}
