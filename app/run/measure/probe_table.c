#include "app/run/measure/measure.h"

#include "app/base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Relative tolerance of a row's age: times were written with twelve digits. */
static const double ROUNDING = 1e-9;

void probe_window_free(ProbeWindow *window)
{
    free(window->time);
    free(window->value);
    *window = (ProbeWindow){.columns = window->columns, .longest = window->longest};
}

/* Moves the kept rows to the start of the memory; doubles the memory if more than half full. */
static bool make_room(ProbeWindow *w)
{
    const size_t columns = (size_t)w->columns,
                 capacity = 2 * w->count >= w->capacity ? 2 * w->capacity + 64 : w->capacity;
    if (w->first > 0) {
        memmove(w->time, w->time + w->first, w->count * sizeof *w->time);
        memmove(w->value, w->value + w->first * columns, w->count * columns * sizeof *w->value);
        w->first = 0;
    }
    if (capacity == w->capacity)
        return true;
    double *time = realloc(w->time, capacity * sizeof *time);
    w->time = time ? time : w->time;
    float *value = realloc(w->value, capacity * columns * sizeof *value + 1);
    w->value = value ? value : w->value;
    w->capacity = time && value ? capacity : w->capacity;
    return time && value;
}

bool probe_window_add(ProbeWindow *w, double time, const float value[])
{
    if (w->first + w->count == w->capacity && !make_room(w))
        return false;
    const size_t at = w->first + w->count++;
    w->time[at] = time;
    memcpy(w->value + at * (size_t)w->columns, value, (size_t)w->columns * sizeof *value);
    /* keep one row before the window, as the start of the first interval */
    while (w->count > 2 && w->time[w->first + 1] <= time - w->longest * (1 + ROUNDING)) {
        w->first++;
        w->count--;
    }
    return true;
}

double probe_window_mean(const ProbeWindow *w, int column, double seconds)
{
    const size_t last = w->first + w->count - 1, columns = (size_t)w->columns;
    const double from = w->time[last] - seconds * (1 + ROUNDING);
    double sum = 0, all = 0;
    for (size_t k = last; k > w->first && w->time[k] > from; k--) {
        const double held = fmin(w->time[k] - w->time[k - 1], w->time[k] - from),
                     value = (double)w->value[k * columns + (size_t)column];
        if (!isnan(value)) {
            sum += held * value;
            all += held;
        }
    }
    return all > 0 ? sum / all : (double)w->value[last * columns + (size_t)column];
}

static bool fail(const ProbeTable *table, Error *error)
{
    return error_set(error, "%.300s: %s", table->path, strerror(errno));
}

/* Start of the head line of every probe table. */
static const char OURS[] = "time [s]";

static char *header_of(const ProbeTable *table)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return NULL;
    fputs(OURS, out);
    for (int k = 0; k < table->columns; k++) {
        const ProbeColumn *column = probes_column(table->probes, k);
        fprintf(out, ",%s [%s]", column->name, column->unit);
        if (column->average > 0)
            fprintf(out, ",%s_mean [%s]", column->name, column->unit);
    }
    fputc('\n', out);
    fclose(out);
    return text;
}

/* ---- rows ---- */

static void count_in(ProbeFigures *figures, double value)
{
    if (isnan(value))
        return;
    figures->least = figures->rows ? fmin(figures->least, value) : value;
    figures->most = figures->rows ? fmax(figures->most, value) : value;
    figures->sum += value;
    figures->rows++;
}

/* Counts a row, written or to be written, in the statistics. Returns false if memory is short. */
static bool take_row(ProbeTable *table, double time, const float value[])
{
    table->last = time;
    for (int k = 0; k < table->columns; k++)
        count_in(&table->figures[k], (double)value[k]);
    return probe_window_add(&table->window, time, value);
}

static void put_number(FILE *file, double value)
{
    fputc(',', file);
    if (!isnan(value))
        fprintf(file, "%.9g", value);
}

static bool put_row(ProbeTable *table, double time, const float value[])
{
    char text[32];
    snprintf(text, sizeof text, "%.12g", time);
    if (!take_row(table, strtod(text, NULL), value)) /* the time as a resumed run will read it back */
        return false;
    fputs(text, table->file);
    for (int k = 0; k < table->columns; k++) {
        const double average = probes_column(table->probes, k)->average;
        put_number(table->file, (double)value[k]);
        if (average > 0)
            put_number(table->file, probe_window_mean(&table->window, k, average));
    }
    fputc('\n', table->file);
    return true;
}

/* Reads a field and its comma; returns false at the end of the line. */
static bool read_field(const char **at, double *value)
{
    char *end;
    if (**at != ',')
        return false;
    *value = strtod(++*at, &end);
    if (end == *at)
        *value = (double)NAN;
    *at = end;
    return *at[0] == ',' || *at[0] == '\n';
}

/* Reads a line of the file as a row; returns false if the line is incomplete. */
static bool read_row(const ProbeTable *table, const char *line, double *time, float value[])
{
    char *end;
    double number = (double)NAN, mean;
    *time = strtod(line, &end);
    const char *at = end;
    bool whole = end != line;
    for (int k = 0; whole && k < table->columns; k++) {
        whole = read_field(&at, &number);
        value[k] = (float)number;
        if (whole && probes_column(table->probes, k)->average > 0)
            whole = read_field(&at, &mean);
    }
    return whole && *at == '\n';
}

/* Reads the rows up to `keep`, and leaves the file position after them. */
static bool keep_rows(ProbeTable *table, double keep, Error *error)
{
    char *line = NULL;
    size_t capacity = 0;
    float *value = malloc(((size_t)table->columns + 1) * sizeof *value);
    double time;
    bool memory = value != NULL;
    long end = ftell(table->file);
    while (memory && getline(&line, &capacity, table->file) > 0 && read_row(table, line, &time, value) &&
           time <= keep * (1 + 1e-9)) {
        memory = take_row(table, time, value);
        end = ftell(table->file);
    }
    free(line);
    free(value);
    if (!memory)
        return error_set(error, "no memory for the table of probes");
    return fseek(table->file, end, SEEK_SET) == 0 || fail(table, error);
}

/* Returns true if the file's first line is `header`; the file position is then after the line. */
static bool has_header(FILE *file, const char *header)
{
    char *line = NULL;
    size_t capacity = 0;
    const bool same = getline(&line, &capacity, file) > 0 && strcmp(line, header) == 0;
    free(line);
    return same;
}

static bool go_on(ProbeTable *table, const char *header, double keep, Error *error)
{
    if (!has_header(table->file, header))
        return error_set(error, "%.300s: is no table of this scene's probes; name another file", table->path);
    return keep_rows(table, keep, error) &&
           (ftruncate(fileno(table->file), ftell(table->file)) == 0 || fail(table, error));
}

/* Returns true if the file is empty or a probe table; false for measurements or tables of heights. */
static bool is_ours(FILE *file, const char *path, Error *error)
{
    char start[sizeof OURS];
    const size_t size = fread(start, 1, sizeof OURS - 1, file);
    return size == 0 || (size == sizeof OURS - 1 && memcmp(start, OURS, size) == 0) ||
           error_set(error, "%.300s: is there already, and no probes wrote it; name another file", path);
}

bool probe_table_check(const char *path, Error *error)
{
    FILE *file = fopen(path, "r");
    const bool ours = !file || is_ours(file, path, error);
    if (file)
        fclose(file);
    return ours;
}

static bool begin(ProbeTable *table, const char *header, Error *error)
{
    if (!is_ours(table->file, table->path, error))
        return false;
    rewind(table->file);
    return (ftruncate(fileno(table->file), 0) == 0 && fputs(header, table->file) >= 0 &&
            fflush(table->file) == 0) ||
           fail(table, error);
}

static bool open_file(ProbeTable *table, const char *path, Error *error)
{
    if (!output_check(path, error))
        return false;
    snprintf(table->path, sizeof table->path, "%s", path);
    const int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    table->file = file >= 0 ? fdopen(file, "r+") : NULL;
    if (file >= 0 && !table->file)
        close(file);
    return table->file ? output_lock(&table->lock, path, error) : fail(table, error);
}

bool probe_table_open(ProbeTable *table, const char *path, const Probes *probes, double keep, Error *error)
{
    const bool old = keep >= 0 && access(path, F_OK) == 0;
    *table = (ProbeTable){.probes = probes, .columns = probes_columns(probes), .last = -1};
    table->window.columns = table->columns;
    for (int k = 0; k < table->columns; k++)
        table->window.longest = fmax(table->window.longest, probes_column(probes, k)->average);
    table->figures = calloc((size_t)table->columns + 1, sizeof *table->figures);
    char *header = header_of(table);
    bool open = false;
    if (!table->figures || !header)
        error_set(error, "no memory for the table of probes");
    else
        open = open_file(table, path, error) &&
               (old ? go_on(table, header, keep, error) : begin(table, header, error));
    free(header);
    if (!open) {
        Error none;
        probe_table_close(table, &none);
        probe_table_free(table);
    }
    return open;
}

bool probe_table_add(ProbeTable *table, double time, const float value[])
{
    const size_t columns = (size_t)table->columns;
    if (table->waiting == table->capacity) {
        const size_t capacity = 2 * table->capacity + 16;
        double *times = realloc(table->time, capacity * sizeof *times);
        table->time = times ? times : table->time;
        float *values = realloc(table->value, capacity * columns * sizeof *values + 1);
        table->value = values ? values : table->value;
        if (!times || !values)
            return false;
        table->capacity = capacity;
    }
    table->time[table->waiting] = time;
    memcpy(table->value + table->waiting++ * columns, value, columns * sizeof *value);
    return true;
}

void probe_table_drop(ProbeTable *table)
{
    table->waiting = 0;
}

bool probe_table_write(ProbeTable *table, Error *error)
{
    for (size_t k = 0; k < table->waiting; k++)
        if (!put_row(table, table->time[k], table->value + k * (size_t)table->columns))
            return error_set(error, "no memory for the table of probes");
    table->waiting = 0;
    return (fflush(table->file) == 0 && !ferror(table->file)) || fail(table, error);
}

bool probe_table_close(ProbeTable *table, Error *error)
{
    FILE *file = table->file;
    table->file = NULL;
    const bool closed = !file || fclose(file) == 0 || fail(table, error);
    output_unlock(&table->lock);
    return closed;
}

void probe_table_free(ProbeTable *table)
{
    probe_window_free(&table->window);
    free(table->figures);
    free(table->time);
    free(table->value);
    *table = (ProbeTable){.file = NULL};
}

json_t *probe_table_json(const ProbeTable *table)
{
    json_t *all = json_object();
    for (int k = 0; all && k < table->columns; k++) {
        const ProbeColumn *column = probes_column(table->probes, k);
        const ProbeFigures *f = &table->figures[k];
        const double mean = f->rows ? f->sum / (double)f->rows : (double)NAN;
        json_object_set_new(all, column->name,
                            json_pack("{s:s, s:I, s:o, s:o, s:o}", "unit", column->unit, "rows",
                                      (json_int_t)f->rows, "mean", number_json(mean), "min",
                                      number_json(f->rows ? f->least : (double)NAN), "max",
                                      number_json(f->rows ? f->most : (double)NAN)));
    }
    return all;
}
