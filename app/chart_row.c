#include "app/chart_row.h"

#include "app/output.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char HEAD[] = "key,role,method,backend,step,fineness,spacing,particles,seconds,error,series";

static bool parse_row(char *line, ChartRow *row)
{
    char *cells[10], *at = line;
    for (int c = 0; c < 10; c++) {
        cells[c] = strsep(&at, ",");
        if (!cells[c])
            return false;
    }
    *row = (ChartRow){.key = strtoull(cells[0], NULL, 16),
                      .role = (ChartRole)strtol(cells[1], NULL, 10),
                      .fineness = (int)strtol(cells[5], NULL, 10),
                      .spacing = strtod(cells[6], NULL),
                      .particles = strtoul(cells[7], NULL, 10),
                      .seconds = strtod(cells[8], NULL),
                      .error = strtod(cells[9], NULL)};
    snprintf(row->method, NAME_SIZE, "%.31s", cells[2]);
    snprintf(row->backend, NAME_SIZE, "%.31s", cells[3]);
    snprintf(row->step, NAME_SIZE, "%.31s", cells[4]);
    for (int i = 0; i < CHART_TIMES * CHART_QUANTITIES && at; i++)
        row->series[i / CHART_QUANTITIES][i % CHART_QUANTITIES] = strtod(strsep(&at, " "), NULL);
    return true;
}

void chart_rows_read(ChartRows *rows, const char *path)
{
    char *line = NULL;
    size_t size = 0;
    FILE *file = fopen(path, "r");
    rows->count = 0;
    if (!file)
        return;
    bool ours = getline(&line, &size, file) > 0 && strncmp(line, HEAD, sizeof HEAD - 1) == 0;
    while (ours && rows->count < CHART_ROWS_MAX && getline(&line, &size, file) > 0)
        if (parse_row(line, &rows->row[rows->count]))
            rows->count++;
    free(line);
    fclose(file);
}

static void print_row(const ChartRow *row, FILE *file)
{
    fprintf(file, "%016" PRIx64 ",%d,%s,%s,%s,%d,%.9g,%zu,%.12g,%.6g,", row->key, (int)row->role, row->method,
            row->backend, row->step, row->fineness, row->spacing, row->particles, row->seconds, row->error);
    for (int i = 0; i < CHART_TIMES * CHART_QUANTITIES; i++)
        fprintf(file, "%s%.9g", i ? " " : "", row->series[i / CHART_QUANTITIES][i % CHART_QUANTITIES]);
    fputc('\n', file);
}

bool chart_rows_write(const ChartRows *rows, const char *path, Error *error)
{
    Output output = {.path = ""};
    if (!output_begin(&output, path, error))
        return false;
    FILE *file = fopen(output.temp, "w");
    if (file) {
        fprintf(file, "%s\n", HEAD);
        for (int i = 0; i < rows->count; i++)
            print_row(&rows->row[i], file);
    }
    if (file && fclose(file) == 0)
        return output_commit(&output, error);
    error_set(error, "%s: cannot be written (%s)", path, strerror(errno));
    output_discard(&output);
    return false;
}

ChartRow *chart_rows_find(ChartRows *rows, uint64_t key)
{
    for (int i = 0; i < rows->count; i++)
        if (rows->row[i].key == key)
            return &rows->row[i];
    return NULL;
}

/* Of a few quantities that belong together: rms distance over the greatest range of one of them. */
static double distance_of(const ChartRow *row, const ChartRow *reference, int first, int last)
{
    double sum2 = 0, range = 0;
    for (int q = first; q <= last; q++) {
        double low = INFINITY, high = -INFINITY;
        for (int t = 0; t < CHART_TIMES; t++) {
            sum2 += pow(row->series[t][q] - reference->series[t][q], 2) / CHART_TIMES;
            low = fmin(low, reference->series[t][q]);
            high = fmax(high, reference->series[t][q]);
        }
        range = fmax(range, high - low);
    }
    return range > 0 ? sqrt(sum2) / range : 0;
}

double chart_distance(const ChartRow *row, const ChartRow *reference)
{
    return 0.5 * (distance_of(row, reference, 0, 2) + distance_of(row, reference, 3, 3));
}

double chart_rows_compare(ChartRows *rows)
{
    const ChartRow *reference = NULL;
    double floor = (double)NAN;
    for (int i = 0; i < rows->count; i++)
        if (rows->row[i].role == CHART_REFERENCE && isfinite(rows->row[i].seconds))
            reference = &rows->row[i];
    for (int i = 0; i < rows->count; i++) {
        ChartRow *row = &rows->row[i];
        if (reference)
            row->error = isfinite(row->seconds) ? chart_distance(row, reference) : (double)NAN;
        for (int k = 0; k < i && row->role == CHART_FLOOR; k++)
            if (rows->row[k].role == CHART_FLOOR)
                floor = fmax(floor,
                             chart_distance(row, &rows->row[k])); /* fmax takes the number of a NaN's two */
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
