/* Tables in text: a line with the names of the columns, then a line a particle. Lines that begin with '#' and
   empty lines do not count. Cells are separated by commas, semicolons, tabs or spaces, as in the line of
   names; names may be in quotes. An empty cell is a number that is none. */
#include "app/files/foreign/foreign.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Csv {
    const ForeignBytes *file;
    const char *at, *end;
    int line;
    char between;
    Error *error;
} Csv;

static bool next_line(Csv *csv, const char **begin, const char **end)
{
    while (csv->at < csv->end) {
        const char *newline = memchr(csv->at, '\n', (size_t)(csv->end - csv->at));
        *begin = csv->at;
        *end = newline ? newline : csv->end;
        csv->at = newline ? newline + 1 : csv->end;
        csv->line++;
        while (*end > *begin && ((*end)[-1] == ' ' || (*end)[-1] == '\r'))
            --*end;
        while (*begin < *end && **begin == ' ')
            ++*begin;
        if (*end > *begin && **begin != '#')
            return true;
    }
    return false;
}

static char separator_of(const char *at, const char *end)
{
    static const char kinds[] = ";\t, ";
    for (const char *kind = kinds; *kind; kind++)
        for (const char *c = at; c < end; c++)
            if (*c == *kind)
                return *kind;
    return ',';
}

/* The end of the cell at `at`. */
static const char *cell_end(const Csv *csv, const char *at, const char *end)
{
    const char *quote = at < end && *at == '"' ? memchr(at + 1, '"', (size_t)(end - at - 1)) : NULL;
    at = quote ? quote + 1 : at;
    const char *stop = memchr(at, csv->between, (size_t)(end - at));
    return stop ? stop : end;
}

/* The begin of the cell behind a separator at `at`; several spaces count once. */
static const char *skip(const Csv *csv, const char *at, const char *end)
{
    at += at < end;
    while (at < end && *at == ' ')
        at++;
    (void)csv;
    return at;
}

static bool take_names(Csv *csv, ForeignTable *table, const char *at, const char *end)
{
    char name[FOREIGN_NAME_SIZE];
    csv->between = separator_of(at, end);
    for (bool more = true; more;) {
        const char *stop = cell_end(csv, at, end), *from = at, *to = stop;
        while (to > from && to[-1] == ' ')
            to--;
        if (to - from > 1 && *from == '"' && to[-1] == '"')
            from++, to--;
        const size_t length = to - from < FOREIGN_NAME_SIZE ? (size_t)(to - from) : FOREIGN_NAME_SIZE - 1;
        memcpy(name, from, length);
        name[length] = '\0';
        more = stop < end;
        if ((more || length > 0) && !foreign_column_add(table, csv->file->path, name, 1, csv->error))
            return false;
        at = skip(csv, stop, end);
    }
    return true;
}

/* Lines left, an upper limit for particles. */
static size_t count_lines(const Csv *csv)
{
    size_t count = 1;
    for (const char *c = csv->at; c < csv->end && (c = memchr(c, '\n', (size_t)(csv->end - c))); c++)
        count++;
    return count;
}

static bool take_cell(Csv *csv, const char *at, const char *stop, const char *name, double *value)
{
    const bool quoted = stop - at > 1 && *at == '"' && stop[-1] == '"';
    const char *from = at + quoted, *end = stop - quoted;
    while (end > from && end[-1] == ' ')
        end--;
    *value = NAN;
    if (from == end)
        return true;
    char copy[64];
    const char *comma = csv->between != ',' ? memchr(from, ',', (size_t)(end - from)) : NULL;
    const size_t length = (size_t)(end - from);
    if (comma && length < sizeof copy) { /* a decimal comma */
        memcpy(copy, from, length);
        copy[comma - from] = '.';
        from = copy;
        end = copy + length;
    }
    return (foreign_number(&from, end, value) && from == end) ||
           error_set(csv->error, "%.300s:%d: '%.*s' is no number, in the column '%s'; write one such as 0.25",
                     csv->file->path, csv->line, (int)(length < 40 ? length : 40), at, name);
}

static bool take_row(Csv *csv, ForeignTable *table, const char *at, const char *end)
{
    double value;
    bool more = true;
    int k = 0;
    for (; k < table->column_count && more; k++) {
        ForeignColumn *column = &table->column[k];
        const char *stop = cell_end(csv, at, end);
        const bool timed = column->role == FOREIGN_TIME && isnan(table->time);
        if (column->value || timed) {
            if (!take_cell(csv, at, stop, column->name, &value))
                return false;
            table->time = timed ? value : table->time;
            if (column->value)
                column->value[table->count] = value;
        }
        more = stop < end;
        at = skip(csv, stop, end);
    }
    if (k < table->column_count || (more && at < end))
        return error_set(csv->error, "%.300s:%d: has %s cells than the line of names, which names %d columns",
                         csv->file->path, csv->line, k < table->column_count ? "fewer" : "more",
                         table->column_count);
    table->count++;
    return true;
}

static bool parse(const ForeignBytes *file, ForeignTable *table, Error *error)
{
    static const char mark[] = "\xef\xbb\xbf"; /* byte order mark */
    const size_t from = file->size >= 3 && memcmp(file->bytes, mark, 3) == 0 ? 3 : 0;
    Csv csv = {.file = file, .at = file->bytes + from, .end = file->bytes + file->size, .error = error};
    const char *begin, *end;
    if (memchr(file->bytes, 0, file->size < 4096 ? file->size : 4096))
        return error_set(error, "%.300s: is no text; a table is a line of names, then a line a particle",
                         file->path);
    if (!next_line(&csv, &begin, &end))
        return error_set(error, "%.300s: is empty; a table is a line of names, then a line a particle",
                         file->path);
    table->time = NAN;
    table->count = table->head_only ? 1 : count_lines(&csv);
    if (!take_names(&csv, table, begin, end))
        return false;
    for (table->count = 0; !(table->head_only && table->count > 0) && next_line(&csv, &begin, &end);)
        if (!take_row(&csv, table, begin, end))
            return false;
    return true;
}

static const char *const endings[] = {".csv", NULL};

const ForeignFormat foreign_csv = {.name = "a table", .endings = endings, .parse = parse};
