#include "app/scene/import/import.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { AXES = 3, COLUMNS = AXES + FIELD_TABLE_COLUMNS, CELL_SIZE = 64, ROWS_MAX = 1 << 22 };

const FieldFileKind field_file_heights = {"xz", {"height"}, "m", "x, z; height"};
const FieldFileKind field_file_velocities = {"xyz", {"vx", "vy", "vz"}, "m/s", "x, y, z; vx, vy, vz"};

/* Coordinates, then quantities. */
typedef struct FieldRow {
    int line;
    double cell[COLUMNS];
} FieldRow;

typedef struct FieldReader {
    const char *path, *at, *end;
    const FieldFileKind *kind;
    int line;
    char between;                  /* separator of cells */
    int columns, meaning[COLUMNS]; /* for each column: index in a row */
    bool has[COLUMNS];
    FieldRow *rows;
    size_t count, capacity;
    Error *error;
} FieldReader;

#define WRONG(r, number, format, ...)                                                                        \
    error_set((r)->error, "%.300s:%d: " format, (r)->path, (number), __VA_ARGS__)

static bool no_memory(const FieldReader *r)
{
    return error_set(r->error, "%.300s: no memory for its table; name a smaller one", r->path);
}

/* Finds the next line with content, without the line end; false after the last line. */
static bool next_line(FieldReader *r, const char **line, const char **end)
{
    while (r->at < r->end) {
        const char *newline = memchr(r->at, '\n', (size_t)(r->end - r->at));
        *line = r->at;
        *end = newline ? newline : r->end;
        r->at = newline ? newline + 1 : r->end;
        r->line++;
        while (*end > *line && strchr(" \t\r", (*end)[-1]) && (*end)[-1])
            --*end;
        if (*end > *line && **line != '#')
            return true;
    }
    return false;
}

/* Separator of a line: the first semicolon, tab or comma. */
static char separator_of(const char *line, const char *end)
{
    for (; line < end; line++)
        if (*line == ';' || *line == '\t' || *line == ',')
            return *line;
    return ',';
}

/* End of a cell; a quoted cell ends after the quotes. */
static const char *cell_end(const FieldReader *r, const char *at, const char *end)
{
    while (at < end && *at == ' ')
        at++;
    const char *quote = at < end && *at == '"' ? memchr(at + 1, '"', (size_t)(end - at - 1)) : NULL;
    if (quote)
        at = quote + 1;
    while (at < end && *at != r->between)
        at++;
    return at;
}

/* Reads the cell at `*at`, without surrounding spaces and quotes. Moves *at past the separator; NULL after
   the last cell. */
static bool next_cell(const FieldReader *r, const char **at, const char *end, char cell[CELL_SIZE])
{
    const char *begin = *at, *stop = cell_end(r, begin, end);
    *at = stop < end ? stop + 1 : NULL;
    while (begin < stop && (*begin == ' ' || *begin == '\t'))
        begin++;
    while (stop > begin && (stop[-1] == ' ' || stop[-1] == '\t'))
        stop--;
    if (stop - begin > 1 && *begin == '"' && stop[-1] == '"')
        begin++, stop--;
    if (stop - begin >= CELL_SIZE)
        return WRONG(r, r->line, "a cell of %d letters; write a number or a name", (int)(stop - begin));
    if (memchr(begin, 0, (size_t)(stop - begin)))
        return WRONG(r, r->line, "a cell with a byte 0; write a table as %s", "text");
    memcpy(cell, begin, (size_t)(stop - begin));
    cell[stop - begin] = '\0';
    return true;
}

/* --- the names of the columns --- */

/* Index of a named column in a row; -1: unknown name. */
static int meaning_of(const FieldFileKind *kind, const char *name)
{
    if (name[0] && !name[1] && strchr(kind->axes, name[0]))
        return name[0] - 'x';
    for (int k = 0; k < FIELD_TABLE_COLUMNS; k++)
        if (kind->quantity[k] && strcmp(name, kind->quantity[k]) == 0)
            return AXES + k;
    return -1;
}

/* Adds a column named "x (m)" or "x". */
static bool add_column(FieldReader *r, char *cell)
{
    char *open = strchr(cell, '('), *close = open ? strchr(open, ')') : NULL;
    if (r->columns == COLUMNS)
        return WRONG(r, r->line, "more than %d columns; there may be %s", COLUMNS, r->kind->words);
    if (open)
        *open = '\0';
    for (size_t n = strlen(cell); n > 0 && cell[n - 1] == ' '; n--)
        cell[n - 1] = '\0';
    const int what = meaning_of(r->kind, cell);
    if (what < 0)
        return WRONG(r, r->line, "no column '%s' is known; the first line names columns of %s", cell,
                     r->kind->words);
    if (r->has[what])
        return WRONG(r, r->line, "two columns '%s'; name each once", cell);
    const char *unit = what < AXES ? "m" : r->kind->unit;
    if (open && (!close || (size_t)(close - open) != strlen(unit) + 1 ||
                 memcmp(open + 1, unit, strlen(unit)) != 0 || close[1]))
        return WRONG(r, r->line, "'%s' in '(%s'; its unit is (%s)", cell, open + 1, unit);
    r->has[what] = true;
    r->meaning[r->columns++] = what;
    return true;
}

static bool has_between(const FieldReader *r, int begin, int end)
{
    bool any = false;
    for (int k = begin; k < end; k++)
        any |= r->has[k];
    return any;
}

static bool read_header(FieldReader *r)
{
    const char *at, *end;
    char cell[CELL_SIZE] = "";
    if (!next_line(r, &at, &end))
        return error_set(r->error, "%.300s: has no line; the first one names columns of %s", r->path,
                         r->kind->words);
    r->between = separator_of(at, end);
    while (at)
        if (!next_cell(r, &at, end, cell) || !add_column(r, cell))
            return false;
    return (has_between(r, 0, AXES) && has_between(r, AXES, COLUMNS)) ||
           WRONG(r, r->line, "a coordinate and a quantity are needed; name columns of %s", r->kind->words);
}

/* --- the rows --- */

static FieldRow *add_row(FieldReader *r)
{
    if (r->count == r->capacity) {
        const size_t capacity = r->capacity ? 2 * r->capacity : 256;
        FieldRow *rows = capacity > ROWS_MAX ? NULL : realloc(r->rows, capacity * sizeof *rows);
        if (!rows)
            return NULL;
        r->rows = rows;
        r->capacity = capacity;
    }
    FieldRow *row = &r->rows[r->count++];
    *row = (FieldRow){.line = r->line};
    return row;
}

static bool read_row(FieldReader *r, const char *at, const char *end)
{
    char cell[CELL_SIZE];
    FieldRow *row = add_row(r);
    int column = 0;
    if (!row)
        return no_memory(r);
    for (; at; column++) {
        if (!next_cell(r, &at, end, cell))
            return false;
        if (column == r->columns)
            return WRONG(r, r->line, "more than %d cell%s; the first line names %d column%s", r->columns,
                         plural((size_t)r->columns), r->columns, plural((size_t)r->columns));
        char *behind, *comma = r->between == ',' ? NULL : strchr(cell, ',');
        if (comma) /* decimal comma, if commas do not separate cells */
            *comma = '.';
        const double value = strtod(cell, &behind);
        if (behind == cell || *behind || !isfinite(value))
            return WRONG(r, r->line, "'%s' is no number; write one such as 0.25", cell);
        row->cell[r->meaning[column]] = value;
    }
    return column == r->columns || WRONG(r, r->line, "%d cell%s; the first line names %d columns", column,
                                         plural((size_t)column), r->columns);
}

/* --- the grid --- */

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Collects the planes across an axis: each distinct coordinate of a row. */
static bool find_planes(const FieldReader *r, FieldTable *table, int axis)
{
    double *place = malloc((r->count + 1) * sizeof *place);
    int planes = 0;
    table->place[axis] = place;
    if (!place)
        return no_memory(r);
    for (size_t i = 0; i < r->count; i++)
        place[i] = r->rows[i].cell[axis];
    qsort(place, r->count, sizeof *place, ascending);
    for (size_t i = 0; i < r->count; i++)
        if (planes == 0 || place[i] > place[planes - 1])
            place[planes++] = place[i];
    table->count[axis] = planes;
    return !r->has[axis] || planes > 1 ||
           error_set(r->error, "%.300s: %c is %g in all rows; two places are needed, or no column %c",
                     r->path, "xyz"[axis], place[0], "xyz"[axis]);
}

static int plane_of(const FieldTable *table, int axis, double x)
{
    const double *place = table->place[axis];
    return (int)((const double *)bsearch(&x, place, (size_t)table->count[axis], sizeof x, ascending) - place);
}

static size_t index_of(const FieldTable *table, const FieldRow *row)
{
    size_t index = 0;
    for (int k = AXES - 1; k >= 0; k--)
        index = index * (size_t)table->count[k] + (size_t)plane_of(table, k, row->cell[k]);
    return index;
}

/* Writes the coordinates of the table's axes: "x 0.5, z 0". */
static void place_words(const FieldReader *r, const double at[AXES], char words[128])
{
    int used = 0;
    for (int k = 0; k < AXES; k++)
        if (r->has[k])
            used +=
                snprintf(words + used, (size_t)(128 - used), "%s%c %g", used ? ", " : "", "xyz"[k], at[k]);
}

static bool missing(const FieldReader *r, const double at[AXES], const int planes[AXES])
{
    char words[128];
    place_words(r, at, words);
    return error_set(r->error,
                     "%.300s: has no row for %s; a grid has one for each of its %d x %d x %d places", r->path,
                     words, planes[0], planes[1], planes[2]);
}

/* Returns false and reports the first place without a row. */
static bool is_full(const FieldReader *r, const FieldTable *table, const int *line)
{
    for (int z = 0; z < table->count[2]; z++)
        for (int y = 0; y < table->count[1]; y++)
            for (int x = 0; x < table->count[0]; x++)
                if (!*line++)
                    return missing(r, (double[]){table->place[0][x], table->place[1][y], table->place[2][z]},
                                   table->count);
    return true;
}

/* Stores rows at their places; `line` has the line number of each place's row, 0: none yet. */
static bool place_rows(const FieldReader *r, FieldTable *table, int *line)
{
    char words[128];
    for (size_t i = 0; i < r->count; i++) {
        const FieldRow *row = &r->rows[i];
        const size_t index = index_of(table, row);
        place_words(r, row->cell, words);
        if (line[index])
            return WRONG(r, row->line, "a second row for %s, which line %d has; leave one out", words,
                         line[index]);
        line[index] = row->line;
        for (int k = 0; k < FIELD_TABLE_COLUMNS; k++)
            if (table->value[k])
                table->value[k][index] = row->cell[AXES + k];
    }
    return is_full(r, table, line);
}

static bool make_grid(const FieldReader *r, FieldTable *table)
{
    double places = 1;
    for (int k = 0; k < AXES; k++) {
        if (!find_planes(r, table, k))
            return false;
        places *= table->count[k];
    }
    if (places > 2.0 * ROWS_MAX) /* far more places than rows */
        return error_set(r->error,
                         "%.300s: is no grid: its %zu rows have %d places in x, %d in y, %d in z; write a "
                         "row for each place of a grid",
                         r->path, r->count, table->count[0], table->count[1], table->count[2]);
    bool ok = true;
    int *line = calloc((size_t)places, sizeof *line);
    for (int k = 0; k < FIELD_TABLE_COLUMNS; k++)
        if (r->has[AXES + k])
            ok &= (table->value[k] = calloc((size_t)places, sizeof(double))) != NULL;
    ok = line && ok ? place_rows(r, table, line) : no_memory(r);
    free(line);
    return ok;
}

static bool read_all(FieldReader *r, FieldTable *table)
{
    const char *line, *end;
    if (!read_header(r))
        return false;
    while (next_line(r, &line, &end))
        if (!read_row(r, line, end))
            return false;
    return (r->count > 0 ||
            error_set(r->error, "%.300s: has no row behind the names of its columns; write one a place",
                      r->path)) &&
           make_grid(r, table);
}

FieldTable *field_file_parse(const char *path, const char *bytes, size_t size, const FieldFileKind *kind,
                             Error *error)
{
    static const char mark[] = "\xef\xbb\xbf"; /* byte order mark, which some programs write before UTF-8 */
    const size_t skip = size >= 3 && memcmp(bytes, mark, 3) == 0 ? 3 : 0;
    FieldReader r = {.path = path, .at = bytes + skip, .end = bytes + size, .kind = kind, .error = error};
    FieldTable *table = calloc(1, sizeof *table);
    if (!table)
        no_memory(&r);
    else if (!read_all(&r, table)) {
        field_file_free(table);
        table = NULL;
    }
    free(r.rows);
    return table;
}

void field_file_free(FieldTable *table)
{
    for (int k = 0; table && k < AXES; k++)
        free(table->place[k]);
    for (int k = 0; table && k < FIELD_TABLE_COLUMNS; k++)
        free(table->value[k]);
    free(table);
}
