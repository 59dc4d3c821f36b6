#include "app/lab/run_key.h"

#include "app/scene/keys.h"

#include <stdlib.h>
#include <string.h>

static uint64_t hash(uint64_t h, const char *text, size_t size)
{
    for (size_t i = 0; i < size; i++) /* FNV-1a */
        h = (h ^ (uint8_t)text[i]) * 0x100000001b3ULL;
    return (h ^ 0xff) * 0x100000001b3ULL;
}

static uint64_t hash_numbers(uint64_t h, const double numbers[], size_t count)
{
    return hash(h, (const char *)numbers, count * sizeof *numbers);
}

/* What a table holds: its file keeps its name. */
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

static uint64_t hash_tables(uint64_t h, const WorldDef *def)
{
    for (int f = 0; f < def->fluid_count; f++) {
        h = hash_table(h, def->fluids[f].flow_table);
        for (int i = 0; i < def->fluids[f].fill_count; i++)
            h = hash_table(h, def->fluids[f].fills[i].heights);
    }
    return h;
}

uint64_t run_key_text(uint64_t key, const char *text)
{
    return hash(key, text, strlen(text));
}

bool run_key_scene(const Scene *scene, bool looks, uint64_t *key, Error *error)
{
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
