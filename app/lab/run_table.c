#define _GNU_SOURCE /* dl_iterate_phdr */
#include "app/lab/run_table.h"

#include "app/base/output.h"
#include "app/scene/keys.h"
#include "sim/base/sums.h"
#include "sim/mesh/mesh_shape.h"

#include <elf.h>
#include <errno.h>
#include <link.h>
#include <stdlib.h>
#include <string.h>

bool row_number(const char *text, double *number)
{
    char *end;
    *number = strtod(text, &end);
    return end != text && !*end;
}

/* Cells are separated by commas: a comma in a text is written as this character. */
static const char COMMA = '|';

void row_put_text(const char *text, FILE *file)
{
    for (; *text; text++)
        fputc(*text == ',' ? COMMA : *text, file);
    fputc(',', file);
}

bool row_text(char *text, size_t size, const char *cell)
{
    const bool whole = (size_t)snprintf(text, size, "%s", cell) < size;
    for (; *text; text++)
        *text = *text == COMMA ? ',' : *text;
    return whole;
}

bool row_outcome(char *const cells[3], Outcome *outcome)
{
    outcome->kind = outcome_of_word(cells[0]);
    return outcome->kind < OUTCOME_COUNT && row_number(cells[1], &outcome->time) &&
           row_text(outcome->words, sizeof outcome->words, cells[2]);
}

bool rows_write(const char *path, bool (*print)(const void *rows, FILE *file), const void *rows, Error *error)
{
    Output output = {.path = ""};
    if (!output_begin(&output, path, error))
        return false;
    FILE *file = fopen(output.temp, "w");
    if (file) {
        const bool whole = print(rows, file) && !ferror(file);
        if (fclose(file) == 0 && whole)
            return output_commit(&output, error);
    }
    error_set(error, "%s: cannot be written (%s)", path, strerror(errno));
    output_discard(&output);
    return false;
}

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
