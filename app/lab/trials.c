#define _GNU_SOURCE /* dl_iterate_phdr */
#include "app/lab/trials.h"

#include "app/base/file.h"
#include "app/scene/scene.h"
#include "sim/base/base.h"
#include "sim/mesh/mesh_shape.h"

#include <elf.h>
#include <errno.h>
#include <inttypes.h>
#include <link.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- rows in memory ---- */

void trials_free(Trials *trials)
{
    free(trials->keys);
    free(trials->rows);
    *trials = (Trials){.table = trials->table};
}

int trials_place(const Trials *trials, uint64_t key)
{
    for (int i = 0; i < trials->count; i++)
        if (trials->keys[i] == key)
            return i;
    return -1;
}

void *trials_find(const Trials *trials, uint64_t key)
{
    const int at = trials_place(trials, key);
    return at < 0 ? NULL : trials_row(trials, at);
}

static bool has_room(Trials *trials)
{
    if (trials->count < trials->capacity)
        return true;
    const int capacity = trials->capacity > 0 ? 2 * trials->capacity : 64;
    uint64_t *keys = realloc(trials->keys, (size_t)capacity * sizeof *keys);
    trials->keys = keys ? keys : trials->keys;
    char *rows = keys ? realloc(trials->rows, (size_t)capacity * trials->table->row_size) : NULL;
    if (!rows)
        return false;
    trials->rows = rows;
    trials->capacity = capacity;
    return true;
}

void *trials_append(Trials *trials, const void *row)
{
    if (!has_room(trials))
        return NULL;
    void *at = trials_row(trials, trials->count);
    memcpy(at, row, trials->table->row_size);
    memcpy(&trials->keys[trials->count++], row, sizeof *trials->keys);
    return at;
}

static bool drop_oldest(Trials *trials, const Trials *keep)
{
    int oldest = 0;
    while (oldest < trials->count && keep && trials_find(keep, trials->keys[oldest]))
        oldest++;
    if (oldest == trials->count)
        return false;
    const size_t after = (size_t)(--trials->count - oldest);
    memmove(&trials->keys[oldest], &trials->keys[oldest + 1], after * sizeof *trials->keys);
    memmove(trials_row(trials, oldest), trials_row(trials, oldest + 1), after * trials->table->row_size);
    return true;
}

bool trials_add(Trials *trials, const void *row, const Trials *keep)
{
    uint64_t key;
    memcpy(&key, row, sizeof key);
    void *own = trials_find(trials, key);
    if (own) {
        memmove(own, row, trials->table->row_size);
        return true;
    }
    const bool full = trials->table->most > 0 && trials->count == trials->table->most;
    return (!full || drop_oldest(trials, keep)) && trials_append(trials, row);
}

/* ---- cells ---- */

/* Cells are separated by commas: a comma in a text is written as this character. */
static const char COMMA = '|';

static void put_text(const char *text, FILE *file)
{
    for (; *text; text++)
        fputc(*text == ',' ? COMMA : *text, file);
}

static bool take_text(char *text, size_t size, const char *cell)
{
    const bool whole = (size_t)snprintf(text, size, "%s", cell) < size;
    for (; *text; text++)
        *text = *text == COMMA ? ',' : *text;
    return whole;
}

static bool take_number(const char *cell, double *number)
{
    char *end;
    *number = strtod(cell, &end);
    return end != cell && !*end;
}

static bool in_range(const TrialColumn *column, double number)
{
    if (isnan(number))
        return column->flags & CELL_NAN;
    return (column->flags & CELL_OPEN ? number > column->least : number >= column->least) &&
           (column->most == 0 ? isfinite(number) : number <= column->most);
}

static bool take_word(const TrialColumn *column, const char *cell, char *member)
{
    for (int i = 0; column->words[i]; i++)
        if (strcmp(column->words[i], cell) == 0) {
            memcpy(member, &i, sizeof i);
            return true;
        }
    return false;
}

static bool take_outcome(char *const cells[3], char *member)
{
    Outcome outcome = {.kind = outcome_of_word(cells[0])};
    const bool ok = outcome.kind < OUTCOME_COUNT && take_number(cells[1], &outcome.time) &&
                    take_text(outcome.words, sizeof outcome.words, cells[2]);
    memcpy(member, &outcome, sizeof outcome);
    return ok;
}

static void set_integer(const TrialColumn *column, double number, char *member)
{
    const int64_t wide = (int64_t)number;
    const int32_t narrow = (int32_t)wide;
    memcpy(member, column->size == sizeof wide ? (const void *)&wide : &narrow, column->size);
}

static int64_t integer_of(const TrialColumn *column, const char *member)
{
    int64_t wide;
    int32_t narrow;
    memcpy(column->size == sizeof wide ? (void *)&wide : &narrow, member, column->size);
    return column->size == sizeof wide ? wide : narrow;
}

/* Reads a number into the row; `wrong` gets the column's name if the number is out of range. */
static bool take_numeric(const TrialColumn *column, const char *cell, char *member, const char **wrong)
{
    double number;
    if (!take_number(cell, &number))
        return false;
    if (!in_range(column, number))
        *wrong = *wrong ? *wrong : column->name;
    else if (column->kind == CELL_INTEGER)
        set_integer(column, number, member);
    else
        memcpy(member, &number, sizeof number);
    return true;
}

static bool take_cell(const TrialColumn *column, char *const cells[3], char *row, const char **wrong)
{
    char *member = row + column->offset;
    switch (column->kind) {
    case CELL_TEXT:
        return take_text(member, column->size, cells[0]) && (*member || column->flags & CELL_EMPTY);
    case CELL_WORD:
        return take_word(column, cells[0], member);
    case CELL_INTEGER:
    case CELL_NUMBER:
        return take_numeric(column, cells[0], member, wrong);
    case CELL_OUTCOME:
        return take_outcome(cells, member);
    case CELL_OWN:
        break;
    }
    return column->parse(cells[0], row);
}

static void put_cell(const TrialColumn *column, const char *row, FILE *file)
{
    const char *member = row + column->offset;
    const Outcome *outcome = (const void *)member;
    int word;
    switch (column->kind) {
    case CELL_TEXT:
        put_text(member, file);
        break;
    case CELL_WORD:
        memcpy(&word, member, sizeof word);
        fputs(column->words[word], file);
        break;
    case CELL_INTEGER:
        fprintf(file, "%" PRId64, integer_of(column, member));
        break;
    case CELL_NUMBER:
        fprintf(file, "%.*g", column->digits, *(const double *)(const void *)member);
        break;
    case CELL_OUTCOME:
        fprintf(file, "%s,%.9g,", outcome_word(outcome->kind), outcome->time);
        put_text(outcome->words, file);
        break;
    case CELL_OWN:
        column->print(row, file);
    }
}

/* ---- the file ---- */

/* Parses a row. Returns NULL, or the name of the faulty column: such a trial is repeated. */
static const char *parse_row(const TrialTable *table, char *line, char *row)
{
    static const char unreadable[] = "row";
    const char *wrong = NULL;
    char *at = line, *end, *cells[3];
    if (!line[strcspn(line, "\n")])
        return unreadable;
    line[strcspn(line, "\n")] = '\0';
    memset(row, 0, table->row_size);
    cells[0] = strsep(&at, ",");
    const uint64_t key = strtoull(cells[0], &end, 16);
    memcpy(row, &key, sizeof key);
    if (end != cells[0] + 16 || *end)
        return unreadable;
    for (const TrialColumn *column = table->columns; column->name; column++) {
        for (int c = 0; c < (column->kind == CELL_OUTCOME ? 3 : 1); c++)
            if (!(cells[c] = strsep(&at, ",")))
                return unreadable;
        if (!take_cell(column, cells, row, &wrong))
            return unreadable;
    }
    return at || (!wrong && table->possible && !table->possible(row)) ? unreadable : wrong;
}

static bool read_rows(Trials *trials, FILE *file, const char *path, FILE *warnings, Error *error)
{
    const TrialTable *table = trials->table;
    char *line = NULL, *row = malloc(table->row_size);
    size_t size = 0;
    bool ok = row != NULL;
    for (int number = 2; ok && getline(&line, &size, file) > 0; number++) {
        const char *wrong = parse_row(table, line, row);
        if (!wrong)
            ok = trials_append(trials, row);
        else if (warnings)
            fprintf(warnings,
                    "%s:%d: this %s is none that %s writes; the row is left out, its %s made again\n", path,
                    number, wrong, table->who, table->trial);
    }
    free(line);
    free(row);
    return ok || error_set(error, "%s: no memory for its rows", path);
}

bool trials_read(Trials *trials, const char *path, FILE *warnings, Error *error)
{
    const TrialTable *table = trials->table;
    char *head = NULL;
    size_t size = 0;
    FILE *file = fopen(path, "r");
    trials->count = 0;
    if (!file)
        return errno == ENOENT ||
               error_set(error, "%s: cannot be read: %s; it is not replaced", path, strerror(errno));
    const bool empty = getline(&head, &size, file) <= 0;
    bool ok = empty || strncmp(head, table->opening, strlen(table->opening)) == 0;
    const char *who = table->who + (strncmp(table->who, "a ", 2) == 0 ? 2 : 0);
    if (!ok)
        error_set(error,
                  "%s: is there already, and no %s wrote it; give the %s another name, or move that file",
                  path, who, table->result);
    else if (!empty && strcmp(head, table->head) == 0)
        ok = read_rows(trials, file, path, warnings, error);
    else if (!empty && warnings)
        fprintf(warnings, "%s: is of another version of slosh; its rows are left out, its %ss made again\n",
                path, table->trial);
    free(head);
    fclose(file);
    return ok;
}

bool trials_merge(Trials *trials, const char *path, const Trials *keep, Error *error)
{
    const TrialTable *table = trials->table;
    Trials others = {.table = table};
    bool ok = trials_read(&others, path, NULL, error);
    for (int i = 0; ok && i < others.count; i++) {
        const void *other = trials_row(&others, i), *own = trials_find(trials, others.keys[i]);
        const bool full = table->most > 0 && trials->count == table->most;
        if (own ? table->replaces && table->replaces(other, own) : !full)
            ok = trials_add(trials, other, keep) || error_set(error, "%s: no memory for its rows", path);
    }
    trials_free(&others);
    return ok;
}

static void put_row(const TrialTable *table, const char *row, FILE *file)
{
    uint64_t key;
    memcpy(&key, row, sizeof key);
    fprintf(file, "%016" PRIx64, key);
    for (const TrialColumn *column = table->columns; column->name; column++) {
        fputc(',', file);
        put_cell(column, row, file);
    }
    fputc('\n', file);
}

/* Writes the rows in the table's order. Returns false if memory is short. */
static bool put_rows(const void *of, FILE *file)
{
    const Trials *trials = of;
    const TrialTable *table = trials->table;
    const char **sorted = malloc(((size_t)trials->count + 1) * sizeof *sorted);
    if (!sorted)
        return false;
    for (int i = 0; i < trials->count; i++)
        sorted[i] = trials_row(trials, i);
    if (table->order && trials->count > 0)
        qsort(sorted, (size_t)trials->count, sizeof *sorted, table->order);
    fputs(table->head, file);
    for (int i = 0; i < trials->count; i++)
        put_row(table, sorted[i], file);
    free(sorted);
    return true;
}

bool trials_write(const Trials *trials, const char *path, Error *error)
{
    return output_print(path, put_rows, trials, error);
}

bool trials_keep(Trials *trials, const char *path, const Trials *keep, Error *error)
{
    return trials_merge(trials, path, keep, error) && trials_write(trials, path, error);
}

/* ---- keys ---- */

static uint64_t hash(uint64_t h, const char *text, size_t size)
{
    static const uint8_t end = 0xff;
    return hash_add(hash_add(h, text, size), &end, 1);
}

static uint64_t hash_numbers(uint64_t h, const double numbers[], size_t count)
{
    return hash(h, (const char *)numbers, count * sizeof *numbers);
}

/* Hashes the contents of a table, as the file may change under the same name. */
static uint64_t hash_table(uint64_t h, const FieldTable *table)
{
    size_t places = 1;
    if (!table)
        return h;
    for (int k = 0; k < 3; k++) {
        const size_t planes = (size_t)table->count[k];
        h = hash_numbers(h, table->place[k], planes > 1 ? planes : 0);
        places *= planes;
    }
    for (int c = 0; c < FIELD_TABLE_COLUMNS; c++)
        h = hash_numbers(h, table->value[c], table->value[c] ? places : 0);
    return h;
}

/* Hashes the contents of a mesh, for the same reason. */
static uint64_t hash_mesh(uint64_t h, const MeshUse *mesh)
{
    return mesh->shape ? hash(h, (const char *)&mesh->shape->hash, sizeof mesh->shape->hash) : h;
}

static uint64_t hash_tables(uint64_t h, const WorldDef *def)
{
    for (int k = 0; k < def->solid_count; k++)
        h = hash_mesh(h, &def->solids[k].mesh);
    for (int f = 0; f < def->fluid_count; f++) {
        h = hash_table(h, def->fluids[f].flow_table);
        for (int i = 0; i < def->fluids[f].fill_count; i++)
            h = hash_mesh(hash_table(h, def->fluids[f].fills[i].heights), &def->fluids[f].fills[i].mesh);
    }
    return h;
}

/* The program's own build id (elf(5): the note NT_GNU_BUILD_ID), made by the linker from all linked code. */
typedef struct BuildId {
    const char *bytes; /* NULL: no build id */
    size_t size;
} BuildId;

static size_t padded(size_t size)
{
    return (size + 3) & ~(size_t)3;
}

static void find_in_notes(const char *at, size_t left, BuildId *id)
{
    ElfW(Nhdr) note;
    while (left >= sizeof note) {
        memcpy(&note, at, sizeof note);
        const size_t name = padded(note.n_namesz), size = sizeof note + name + padded(note.n_descsz);
        if (size > left)
            return;
        if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == sizeof "GNU" &&
            memcmp(at + sizeof note, "GNU", sizeof "GNU") == 0)
            *id = (BuildId){at + sizeof note + name, note.n_descsz};
        at += size;
        left -= size;
    }
}

/* Looks in the first object, which is the program. */
static int find_build_id(struct dl_phdr_info *object, size_t size, void *id)
{
    (void)size;
    for (int i = 0; i < object->dlpi_phnum; i++)
        if (object->dlpi_phdr[i].p_type == PT_NOTE)
            find_in_notes((const char *)(object->dlpi_addr + object->dlpi_phdr[i].p_vaddr),
                          object->dlpi_phdr[i].p_memsz, id);
    return 1;
}

static bool hash_build(uint64_t *key, Error *error)
{
    BuildId id = {NULL, 0};
    dl_iterate_phdr(find_build_id, &id);
    if (!id.bytes)
        return error_set(error,
                         "this program was linked without --build-id: it cannot tell its own runs from "
                         "those of another build");
    *key = hash(*key, id.bytes, id.size);
    return true;
}

uint64_t run_key_text(uint64_t key, const char *text)
{
    return hash(key, text, strlen(text));
}

bool run_key_scene(const Scene *scene, bool looks, uint64_t *key, Error *error)
{
    if (!hash_build(key, error))
        return false;
    char *text = scene_print_text(scene);
    for (const char *line = text; line && *line;) {
        const size_t size = strcspn(line, "\n");
        if (strncmp(line, "title ", 6) != 0 && (looks || strncmp(line, "view.", 5) != 0) &&
            strncmp(line, "hand.", 5) != 0)
            *key = hash(*key, line, size);
        line += size + (line[size] == '\n');
    }
    free(text);
    *key = hash_tables(*key, &scene->world);
    return text != NULL || error_set(error, "no memory for the settings of %.200s", scene->path);
}
