#include "app/stability/stable_row.h"

#include "app/lab/row_text.h"
#include "app/stability/stable_search.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static const char HEAD[] =
    "key,method,backend,rung,step_s,steps,found_by,outcome,outcome_s,outcome_words,at\n";

/* Start of the head line of every such file, in all versions. */
static const char OURS[] = "key,method,backend,rung,";

static const char *const finders[STABLE_FINDER_COUNT] = {
#define X(NAME, word) word,
    STABLE_FINDERS(X)
#undef X
};

static StableFinder finder_of(const char *word)
{
    int finder = 0;
    while (finder < STABLE_FINDER_COUNT && strcmp(finders[finder], word) != 0)
        finder++;
    return (StableFinder)finder;
}

void stable_rows_free(StableRows *rows)
{
    free(rows->row);
    *rows = (StableRows){.count = 0};
}

/* Returns the index of the key, or its place of insertion. */
static size_t place_of(const StableRows *rows, uint64_t key)
{
    size_t low = 0, high = rows->count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (rows->row[middle].key < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

const StableRow *stable_rows_find(const StableRows *rows, uint64_t key)
{
    const size_t at = place_of(rows, key);
    return at < rows->count && rows->row[at].key == key ? &rows->row[at] : NULL;
}

bool stable_rows_add(StableRows *rows, const StableRow *row)
{
    const size_t at = place_of(rows, row->key);
    if (at < rows->count && rows->row[at].key == row->key) {
        rows->row[at] = *row;
        return true;
    }
    if (rows->count == rows->room) {
        const size_t room = rows->room ? 2 * rows->room : 256;
        StableRow *more = realloc(rows->row, room * sizeof *more);
        if (!more)
            return false;
        rows->row = more;
        rows->room = room;
    }
    memmove(&rows->row[at + 1], &rows->row[at], (rows->count - at) * sizeof *rows->row);
    rows->row[at] = *row;
    rows->count++;
    return true;
}

static bool copy_name(char name[NAME_SIZE], const char *cell)
{
    return row_text(name, NAME_SIZE, cell) && *name;
}

static bool whole(const char *cell, double least, double most, double *number)
{
    return row_number(cell, number) && *number >= least && *number <= most;
}

/* Parses a line in the format of print_row; returns false if the line is unsound. */
static bool parse_row(char *line, StableRow *row)
{
    enum { CELLS = 11 };
    char *cells[CELLS], *at = line, *end;
    double rung, step, steps;
    if (!line[strcspn(line, "\n")])
        return false;
    line[strcspn(line, "\n")] = '\0';
    for (int c = 0; c < CELLS; c++)
        if (!(cells[c] = strsep(&at, ",")))
            return false;
    *row = (StableRow){.key = strtoull(cells[0], &end, 16)};
    if (at || end != cells[0] + 16 || *end || !copy_name(row->method, cells[1]) ||
        !copy_name(row->backend, cells[2]) || !whole(cells[3], -400, 100, &rung) ||
        !whole(cells[4], 0, 1e6, &step) || !whole(cells[5], 0, 1e15, &steps) ||
        !row_outcome(&cells[7], &row->outcome) || !row_text(row->at, STABLE_AT, cells[10]))
        return false;
    row->rung = (int)rung;
    row->steps = (uint64_t)steps;
    row->finder = finder_of(cells[6]);
    return row->finder < STABLE_FINDER_COUNT && row->outcome.kind != OUTCOME_NONE &&
           (row->finder == FOUND_BY_NOBODY) == (row->outcome.kind == OUTCOME_HOLDS);
}

static bool read_rows(StableRows *rows, FILE *file, const char *path, FILE *warnings, Error *error)
{
    char *line = NULL;
    size_t size = 0;
    StableRow row;
    bool ok = true;
    for (int number = 2; ok && getline(&line, &size, file) > 0; number++) {
        if (parse_row(line, &row))
            ok = stable_rows_add(rows, &row) || error_set(error, "%s: no memory for its rows", path);
        else if (warnings)
            fprintf(
                warnings,
                "%s:%d: this row is none that slosh stability writes; it is left out, its trial made again\n",
                path, number);
    }
    free(line);
    return ok;
}

bool stable_rows_read(StableRows *rows, const char *path, FILE *warnings, Error *error)
{
    char *head = NULL;
    size_t size = 0;
    FILE *file = fopen(path, "r");
    rows->count = 0;
    if (!file)
        return errno == ENOENT ||
               error_set(error, "%s: cannot be read: %s; it is not replaced", path, strerror(errno));
    const bool empty = getline(&head, &size, file) <= 0;
    bool ok = empty || strncmp(head, OURS, sizeof OURS - 1) == 0;
    if (!ok)
        error_set(error,
                  "%s: is there already, and no slosh stability wrote it; give the map another name, or move "
                  "that file",
                  path);
    else if (!empty && strcmp(head, HEAD) == 0)
        ok = read_rows(rows, file, path, warnings, error);
    else if (!empty && warnings)
        fprintf(warnings,
                "%s: is of another version of slosh; its rows are left out, its trials made again\n", path);
    free(head);
    fclose(file);
    return ok;
}

bool stable_rows_merge(StableRows *rows, const char *path, Error *error)
{
    StableRows others = {.count = 0};
    bool ok = stable_rows_read(&others, path, NULL, error);
    for (size_t i = 0; ok && i < others.count; i++) {
        const StableRow *other = &others.row[i], *own = stable_rows_find(rows, other->key);
        if (!own || (own->finder == FOUND_BY_LOOK && other->finder != FOUND_BY_LOOK))
            ok = stable_rows_add(rows, other) || error_set(error, "%s: no memory for its rows", path);
    }
    stable_rows_free(&others);
    return ok;
}

static int order(const void *one, const void *other)
{
    const StableRow *a = *(const StableRow *const *)one, *b = *(const StableRow *const *)other;
    int way = strcmp(a->method, b->method);
    way = way ? way : strcmp(a->backend, b->backend);
    way = way ? way : strcmp(a->at, b->at);
    way = way ? way : a->rung - b->rung;
    return way ? way : (a->key > b->key) - (a->key < b->key);
}

static void print_row(const StableRow *row, FILE *file)
{
    const Outcome *outcome = &row->outcome;
    fprintf(file, "%016" PRIx64 ",%s,%s,%d,%.9g,%" PRIu64 ",%s,%s,%.9g,", row->key, row->method, row->backend,
            row->rung, stable_step(row->rung), row->steps, finders[row->finder], outcome_word(outcome->kind),
            outcome->time);
    row_put_text(outcome->words, file);
    for (const char *at = row->at; *at; at++)
        fputc(*at == ',' ? '|' : *at, file);
    fputc('\n', file);
}

static bool print_rows(const void *of, FILE *file)
{
    const StableRows *rows = of;
    const StableRow **sorted = malloc((rows->count + 1) * sizeof *sorted);
    for (size_t i = 0; sorted && i < rows->count; i++)
        sorted[i] = &rows->row[i];
    if (sorted && rows->count > 0)
        qsort(sorted, rows->count, sizeof *sorted, order);
    fputs(HEAD, file);
    for (size_t i = 0; sorted && i < rows->count; i++)
        print_row(sorted[i], file);
    free(sorted);
    return sorted != NULL;
}

bool stable_rows_write(const StableRows *rows, const char *path, Error *error)
{
    return rows_write(path, print_rows, rows, error);
}
