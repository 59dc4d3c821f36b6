#include "sim/world/column.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int column_own(const ColumnDef *column)
{
    return column->at < COLUMN_OWN(0) || column->at >= COLUMN_TERM(0)
               ? -1
               : (int)((column->at - COLUMN_OWN(0)) / sizeof(float *));
}

bool columns_save_own(const ColumnDef *own)
{
    while (own && own->name && !(own->flags & COLUMN_SAVED && column_own(own) >= 0))
        own++;
    return own && own->name;
}

void column_scalar_name(const ColumnDef *column, int component, char name[COLUMN_NAME_SIZE])
{
    snprintf(name, COLUMN_NAME_SIZE, column->components > 1 ? "%s_%c" : "%s", column->name, 'x' + component);
}

int columns_place(const ColumnRows *rows, Scalar scalar)
{
    char name[COLUMN_NAME_SIZE];
    for (int r = 0; r < rows->count; r++)
        for (int k = 0; column_own(rows->row[r]) >= 0 && k < rows->row[r]->components; k++) {
            column_scalar_name(rows->row[r], k, name);
            if (strcmp(name, scalar_name(scalar)) == 0)
                return column_own(rows->row[r]) + k;
        }
    return -1;
}

void **column_array(ParticleColumns *columns, const ColumnDef *column, int component)
{
    return (void **)((char *)columns + column->at) + component;
}

static void *array_of(const ParticleColumns *columns, const ColumnDef *column, int component)
{
    void *array;
    memcpy(&array, (const char *)columns + column->at + (size_t)component * sizeof array, sizeof array);
    return array;
}

size_t column_size(const ColumnDef *column)
{
    static const size_t sizes[] = {
        [COLUMN_FLOAT] = sizeof(float), [COLUMN_INDEX] = sizeof(ParticleId), [COLUMN_BYTE] = 1};
    return sizes[column->type];
}

static void *array_create(size_t count, size_t size, size_t *bytes)
{
    const size_t whole = ((count + COLUMN_PAST + 1) * size + 63) / 64 * 64;
    void *array = aligned_alloc(64, whole);
    if (array)
        memset(array, 0, whole);
    if (bytes)
        *bytes += whole;
    return array;
}

bool columns_create(ParticleColumns *columns, const ColumnRows *rows, size_t count, size_t *bytes)
{
    bool ok = true;
    for (int r = 0; r < rows->count; r++)
        for (int k = 0; k < rows->row[r]->components; k++) {
            void **array = column_array(columns, rows->row[r], k);
            if (!*array)
                *array = array_create(count, column_size(rows->row[r]), bytes);
            ok &= *array != NULL;
        }
    return ok;
}

void columns_destroy(ParticleColumns *columns)
{
    void *all[sizeof *columns / sizeof(void *)];
    memcpy(all, columns, sizeof *columns);
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        free(all[k]);
    *columns = (ParticleColumns){0};
}

static void gather(const ColumnDef *column, const void *from, void *to, const uint32_t *place, size_t begin,
                   size_t end)
{
    if (column->type == COLUMN_BYTE)
        for (size_t k = begin; k < end; k++)
            ((uint8_t *)to)[k] = ((const uint8_t *)from)[place[k]];
    else if (column->type == COLUMN_INDEX)
        for (size_t k = begin; k < end; k++)
            ((ParticleId *)to)[k] = ((const ParticleId *)from)[place[k]];
    else
        for (size_t k = begin; k < end; k++)
            ((float *)to)[k] = ((const float *)from)[place[k]];
}

static void copy(const ColumnDef *column, const void *from, void *to, size_t begin, size_t end)
{
    const size_t size = column_size(column);
    memcpy((char *)to + begin * size, (const char *)from + begin * size, (end - begin) * size);
}

void columns_copy(const ColumnRows *rows, const ParticleColumns *from, const ParticleColumns *to,
                  const uint32_t *place, size_t begin, size_t end)
{
    for (int r = 0; r < rows->count; r++)
        for (int k = 0; k < rows->row[r]->components; k++) {
            const void *source = array_of(from, rows->row[r], k);
            void *target = array_of(to, rows->row[r], k);
            if (source && target && place)
                gather(rows->row[r], source, target, place, begin, end);
            else if (source && target)
                copy(rows->row[r], source, target, begin, end);
        }
}

void columns_move(const ColumnRows *rows, const ParticleColumns *columns, size_t from, size_t to)
{
    for (int r = 0; r < rows->count; r++)
        for (int k = 0; k < rows->row[r]->components; k++) {
            const size_t size = column_size(rows->row[r]);
            char *array = array_of(columns, rows->row[r], k);
            if (array)
                memcpy(array + to * size, array + from * size, size);
        }
}

void columns_clear(const ColumnRows *rows, const ParticleColumns *columns, size_t i)
{
    for (int r = 0; r < rows->count; r++)
        for (int k = 0; k < rows->row[r]->components; k++) {
            const size_t size = column_size(rows->row[r]);
            char *array = array_of(columns, rows->row[r], k);
            if (array)
                memset(array + i * size, 0, size);
        }
}

void columns_swap(const ColumnRows *rows, ParticleColumns *a, ParticleColumns *b)
{
    for (int r = 0; r < rows->count; r++)
        for (int k = 0; k < rows->row[r]->components; k++) {
            void **in_a = column_array(a, rows->row[r], k), **in_b = column_array(b, rows->row[r], k),
                 *kept = *in_a;
            *in_a = *in_b;
            *in_b = kept;
        }
}
