#include "app/base/file.h"
#include "app/lab/error_chart.h"
#include "app/lab/run_table.h"
#include "app/run/measure/metric.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char HEAD[] =
    "key,role,method,backend,step,fineness,spacing_m,particles,seconds_a_simulated_second,error,"
    "outcome,outcome_s,outcome_words,backs,swept,series\n";
static const char *const roles[] = {"point", "reference", "floor", "long"};

/* Start of the head line of every chart's file, in all versions. */
static const char OURS[] = "key,role,method,backend,";

/* Parses "1 2 3"; returns the count of numbers, or -1. */
static int parse_numbers(char *text, double numbers[CHART_QUANTITIES])
{
    int read = 0;
    for (char *cell = strsep(&text, " "); cell; cell = strsep(&text, " "), read++)
        if (read == CHART_QUANTITIES || !row_number(cell, &numbers[read]))
            return -1;
    return read;
}

/* Parses "1 2 3;1.1 2 3;...": CHART_TIMES times with equal counts of numbers; or nothing, for a case. */
static bool parse_series(char *text, ChartRow *row)
{
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

static bool parse_role(const char *name, ChartRole *role)
{
    for (int r = CHART_POINT; r <= CHART_LONG; r++)
        if (strcmp(roles[r], name) == 0) {
            *role = (ChartRole)r;
            return true;
        }
    return false;
}

static bool copy_name(char name[NAME_SIZE], const char *cell)
{
    return snprintf(name, NAME_SIZE, "%s", cell) < NAME_SIZE && *cell;
}

/* Returns the name of a column with an impossible value, or NULL. Valid: NaN seconds of a broken run, NaN
   error without a reference. */
static const char *impossible(const ChartRow *row, double fineness, double particles, double backs)
{
    if (!(fineness >= 0 && fineness < 100))
        return "fineness";
    if (!(row->spacing > 0 && isfinite(row->spacing)))
        return "spacing_m";
    if (!(particles >= 0 && particles < 1e15))
        return "particles";
    if (!(backs >= 0 && backs < 1e9))
        return "backs";
    if (row->seconds <= 0 || isinf(row->seconds))
        return "seconds_a_simulated_second";
    return row->error < 0 || isinf(row->error) ? "error" : NULL;
}

/* Parses a row. Returns NULL, or the name of the faulty column: such a run is repeated. */
static const char *parse_row(char *line, ChartRow *row)
{
    enum { CELLS = 15 };
    static const char unreadable[] = "row";
    char *cells[CELLS], *at = line, *end;
    double fineness, particles, backs;
    if (!line[strcspn(line, "\n")])
        return unreadable;
    line[strcspn(line, "\n")] = '\0';
    for (int c = 0; c < CELLS; c++) {
        cells[c] = strsep(&at, ",");
        if (!at)
            return unreadable;
    }
    *row = (ChartRow){.key = strtoull(cells[0], &end, 16)};
    const bool ok = end == cells[0] + 16 && !*end && parse_role(cells[1], &row->role) &&
                    copy_name(row->method, cells[2]) && copy_name(row->backend, cells[3]) &&
                    copy_name(row->step, cells[4]) && row_number(cells[5], &fineness) &&
                    row_number(cells[6], &row->spacing) && row_number(cells[7], &particles) &&
                    row_number(cells[8], &row->seconds) && row_number(cells[9], &row->error) &&
                    row_outcome(&cells[10], &row->outcome) && row_number(cells[13], &backs) &&
                    row_text(row->swept, CHART_SWEPT, cells[14]) && parse_series(at, row);
    const char *wrong = ok ? impossible(row, fineness, particles, backs) : unreadable;
    if (wrong)
        return wrong;
    row->fineness = (int)fineness;
    row->particles = (size_t)particles;
    row->backs = (unsigned)backs;
    return NULL;
}

static void read_rows(ChartRows *rows, FILE *file, const char *path, FILE *warnings)
{
    char *line = NULL;
    size_t size = 0;
    for (int number = 2; rows->count < CHART_ROWS_MAX && getline(&line, &size, file) > 0; number++) {
        const char *wrong = parse_row(line, &rows->row[rows->count]);
        if (!wrong)
            rows->count++;
        else if (warnings)
            fprintf(warnings,
                    "%s:%d: this %s is none that a chart writes; the row is left out, its run made again\n",
                    path, number, wrong);
    }
    free(line);
}

bool chart_rows_read(ChartRows *rows, const char *path, FILE *warnings, Error *error)
{
    char *head = NULL;
    size_t size = 0;
    FILE *file = fopen(path, "r");
    rows->count = 0;
    if (!file)
        return errno == ENOENT || error_set(error,
                                            "%s: is there, but cannot be read (%s); give the chart "
                                            "another name",
                                            path, strerror(errno));
    const bool empty = getline(&head, &size, file) <= 0;
    const bool ours = empty || strncmp(head, OURS, sizeof OURS - 1) == 0;
    const bool same = !empty && strcmp(head, HEAD) == 0;
    if (same)
        read_rows(rows, file, path, warnings);
    else if (!empty && ours && warnings)
        fprintf(warnings, "%s: is of another version of slosh; its rows are left out, its runs made again\n",
                path);
    free(head);
    fclose(file);
    return ours || error_set(error,
                             "%s: is there already, and no chart wrote it; give the chart another name, or "
                             "move that file",
                             path);
}

void chart_rows_add(ChartRows *rows, const ChartRow *row, const ChartRows *plan)
{
    int oldest = 0;
    for (int i = 0; i < rows->count; i++)
        if (rows->row[i].key == row->key) {
            rows->row[i] = *row;
            return;
        }
    if (rows->count == CHART_ROWS_MAX) {
        while (oldest < rows->count && chart_rows_find(plan, rows->row[oldest].key))
            oldest++;
        if (oldest == rows->count)
            return;
        rows->count--;
        memmove(&rows->row[oldest], &rows->row[oldest + 1],
                (size_t)(rows->count - oldest) * sizeof *rows->row);
    }
    rows->row[rows->count++] = *row;
}

void chart_rows_merge(ChartRows *rows, const char *path, const ChartRows *plan)
{
    static ChartRows others;
    Error none;
    if (!chart_rows_read(&others, path, NULL, &none))
        return;
    for (int i = 0; i < others.count && rows->count < CHART_ROWS_MAX; i++)
        if (!chart_rows_find(rows, others.row[i].key))
            chart_rows_add(rows, &others.row[i], plan);
}

/* Prints the series with all bits: a resumed chart has the same errors. */
static void print_row(const ChartRow *row, FILE *file)
{
    const Outcome *outcome = &row->outcome;
    fprintf(file, "%016" PRIx64 ",%s,%s,%s,%s,%d,%.9g,%zu,%.12g,%.6g,%s,%.9g,", row->key, roles[row->role],
            row->method, row->backend, row->step, row->fineness, row->spacing, row->particles, row->seconds,
            row->error, outcome_word(outcome->kind), outcome->time);
    row_put_text(outcome->words, file);
    fprintf(file, "%u,", row->backs);
    row_put_text(row->swept, file);
    for (int t = 0; t < CHART_TIMES && row->quantities > 0; t++)
        for (int q = 0; q < row->quantities; q++)
            fprintf(file, "%s%.17g", q ? " " : t ? ";" : "", row->series[t][q]);
    fputc('\n', file);
}

static bool print_rows(const void *of, FILE *file)
{
    const ChartRows *rows = of;
    fputs(HEAD, file);
    for (int i = 0; i < rows->count; i++)
        print_row(&rows->row[i], file);
    return true;
}

bool chart_rows_write(const ChartRows *rows, const char *path, Error *error)
{
    return rows_write(path, print_rows, rows, error);
}

const ChartRow *chart_rows_find(const ChartRows *rows, uint64_t key)
{
    for (int i = 0; i < rows->count; i++)
        if (rows->row[i].key == key)
            return &rows->row[i];
    return NULL;
}

const ChartRow *chart_rows_reference(const ChartRows *rows)
{
    for (int i = 0; i < rows->count; i++)
        if (rows->row[i].role == CHART_REFERENCE && isfinite(rows->row[i].seconds))
            return &rows->row[i];
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
    for (int i = 0; i < rows->count; i++) {
        ChartRow *row = &rows->row[i];
        if (reference)
            row->error = isfinite(row->seconds) ? chart_distance(rows, row, reference) : (double)NAN;
        for (int k = 0; k < i && is_floor(row); k++)
            if (is_floor(&rows->row[k])) /* fmax skips NaN */
                floor = fmax(floor, chart_distance(rows, row, &rows->row[k]));
    }
    return floor;
}

bool chart_on_front(const ChartRows *rows, int row)
{
    const ChartRow *mine = &rows->row[row];
    if (mine->role != CHART_POINT || !isfinite(mine->error) || !isfinite(mine->seconds))
        return false;
    for (int i = 0; i < rows->count; i++) {
        const ChartRow *other = &rows->row[i];
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
        if (chart_drawn(&rows->row[i]) && chart_same_line(&rows->row[i], &rows->row[row]))
            return false;
    return chart_drawn(&rows->row[row]);
}

void chart_line_name(const ChartRow *row, char name[CHART_NAME])
{
    snprintf(name, CHART_NAME, "%s, %s%s%s, %s steps", row->method, row->backend, *row->swept ? ", " : "",
             row->swept, row->fineness ? "fine" : "long");
}

/* True if each finer run of the line is more accurate than each coarser run. */
static bool falls(const ChartRows *rows, int first)
{
    const ChartRow *opener = &rows->row[first];
    for (int i = first; i < rows->count; i++)
        for (int k = first; k < rows->count; k++) {
            const ChartRow *a = &rows->row[i], *b = &rows->row[k];
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
    for (int i = first; i < rows->count; i++) {
        const ChartRow *row = &rows->row[i];
        if (!chart_drawn(row) || !chart_same_line(row, &rows->row[first]))
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
    const ChartRow *row = &rows->row[i];
    if (row->role == CHART_REFERENCE)
        return "  the reference";
    return chart_on_front(rows, i) ? "  best for its time" : "";
}

static void print_orders(const ChartRows *rows, double floor, FILE *file)
{
    for (int i = 0; i < rows->count; i++) {
        char name[CHART_NAME];
        const char *why;
        if (!chart_opens_line(rows, i))
            continue;
        chart_line_name(&rows->row[i], name);
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
    for (int i = 0; i < rows->count; i++) {
        const ChartRow *row = &rows->row[i];
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
    static const char *const role_words[] = {[CHART_POINT] = "point",
                                             [CHART_REFERENCE] = "reference",
                                             [CHART_FLOOR] = "floor",
                                             [CHART_LONG] = "long"};
    const ChartRow *row = &rows->row[i];
    json_t *json =
        json_pack("{s:s, s:s, s:s, s:s, s:f, s:I, s:o, s:o, s:b}", "role", role_words[row->role], "method",
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
    for (int i = 0; i < rows->count; i++) {
        const ChartRow *row = &rows->row[i];
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

bool chart_write_json(const ChartRows *rows, const char *subject, const char *error_name, double floor,
                      const char *failure, const char *path, Error *error)
{
    json_t *runs = json_array();
    bool ok = runs != NULL;
    for (int i = 0; ok && i < rows->count; i++)
        ok = json_array_append_new(runs, row_json(rows, i)) == 0;
    json_t *all =
        ok ? json_pack("{s:s, s:s, s:o, s:o, s:O, s:s*}", "chart", subject, "error_of", error_name, "floor",
                       number_json(floor), "orders", orders_json(rows, floor), "runs", runs, "error", failure)
           : NULL;
    const bool written = json_file_write(all, path, error);
    json_decref(all);
    json_decref(runs);
    return written;
}
