#include "sim/gl/packing.h"
#include "sim/world/method.h"

#include <string.h>

static const PackedColumn *packed(const Packing *packing, const ColumnDef *column)
{
    const PackedColumn *row = packing->column;
    while (row->buffer > 0 && row->at != column->at)
        row++;
    return row->buffer > 0 ? row : NULL;
}

ColumnRows packing_rows(const Packing *packing, const Method *method)
{
    const ColumnRows all = column_rows(method->columns, 0, NULL);
    ColumnRows rows = {0};
    for (int r = 0; r < all.count; r++)
        if (packed(packing, all.row[r]))
            rows.row[rows.count++] = all.row[r];
    return rows;
}

static uint32_t word_of(const void *array, ColumnType here, ColumnType there, size_t i)
{
    uint32_t word;
    if (here == COLUMN_BYTE)
        word = ((const uint8_t *)array)[i];
    else if (here == COLUMN_INDEX)
        word = (uint32_t)((const ParticleId *)array)[i]; /* below PARTICLE_IDS_GPU */
    else
        memcpy(&word, (const char *)array + 4 * i, sizeof word);
    if (here != COLUMN_FLOAT && there == COLUMN_FLOAT) {
        const float value = (float)word;
        memcpy(&word, &value, sizeof word);
    }
    return word;
}

static void put_word(uint32_t word, ColumnType there, ColumnType here, void *array, size_t i)
{
    if (here != COLUMN_FLOAT && there == COLUMN_FLOAT) {
        float value;
        memcpy(&value, &word, sizeof word);
        word = (uint32_t)value;
    }
    if (here == COLUMN_BYTE)
        ((uint8_t *)array)[i] = (uint8_t)word;
    else if (here == COLUMN_INDEX)
        ((ParticleId *)array)[i] = word;
    else
        memcpy((char *)array + 4 * i, &word, sizeof word);
}

/* A component of a column in the buffer, for both directions. */
typedef struct PackedPart {
    const PackedColumn *packed;
    ColumnType type;
    void *array;
    int word;
} PackedPart;

/* Lists the components of present columns in `buffer`; returns their number. */
static int parts_of(const Packing *packing, int buffer, const Method *method, ParticleColumns columns,
                    PackedPart parts[PACKED_WORDS])
{
    const ColumnRows rows = packing_rows(packing, method);
    int count = 0;
    for (int r = 0; r < rows.count; r++) {
        const PackedColumn *row = packed(packing, rows.row[r]);
        for (int k = 0; row->buffer == buffer && k < rows.row[r]->components; k++) {
            void *array = *column_array(&columns, rows.row[r], k);
            if (array)
                parts[count++] = (PackedPart){row, rows.row[r]->type, array, row->word + k};
        }
    }
    return count;
}

void packing_pack(const Packing *packing, int buffer, const Method *method, const ParticleColumns *from,
                  size_t count, const ParticleId *place, uint32_t *entries)
{
    PackedPart part[PACKED_WORDS];
    const size_t words = (size_t)packing->words[buffer];
    for (int n = parts_of(packing, buffer, method, *from, part); n-- > 0;)
        for (size_t i = 0; i < count; i++)
            entries[words * (place ? place[i] : i) + (size_t)part[n].word] =
                word_of(part[n].array, part[n].type, part[n].packed->type, i);
}

void packing_unpack(const Packing *packing, int buffer, const Method *method, const uint32_t *entries,
                    size_t count, const ParticleColumns *to)
{
    PackedPart part[PACKED_WORDS];
    const size_t words = (size_t)packing->words[buffer];
    for (int n = parts_of(packing, buffer, method, *to, part); n-- > 0;)
        for (size_t i = 0; i < count; i++)
            put_word(entries[words * i + (size_t)part[n].word], part[n].packed->type, part[n].type,
                     part[n].array, i);
}
