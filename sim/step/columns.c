#include "sim/state.h"
#include "sim/step/backend.h"
#include "sim/step/constants.h"
#include "sim/step/method.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool tense(const Constants *constants)
{
    return constants->tension_model != TENSION_NONE;
}

#define AT(member) .at = offsetof(ParticleColumns, member)
#define KEPT       .flags = COLUMN_SAVED | COLUMN_SORTED

const ColumnDef columns_common[] = {
    {"position", "m", AT(x), 3, COLUMN_FLOAT, KEPT},
    {"velocity", "m/s", AT(vx), 3, COLUMN_FLOAT, KEPT},
    {"id", "", AT(id), 1, COLUMN_INDEX, KEPT},
    {"fluid", "", AT(fluid), 1, COLUMN_BYTE, KEPT},
    {"volume", "", AT(volume), 1, COLUMN_FLOAT},
    {"pressure", "Pa", AT(pressure), 1, COLUMN_FLOAT},
    {"pressure_term", "Pa", AT(pressure_term), 1, COLUMN_FLOAT},
    {"acceleration", "m/s2", AT(ax), 3, COLUMN_FLOAT},
    {"tension", "N/m", AT(tension), 1, COLUMN_FLOAT, .flags = COLUMN_FLUIDS, .needed = tense},
    {"kind", "", AT(kind), 1, COLUMN_FLOAT, .needed = tense},
    {0},
};

static bool wide(const Constants *constants)
{
    return constants->wide;
}

const ColumnDef columns_left[] = {
    {"remainder", "m", .at = COLUMN_OWN(COLUMNS_LEFT), 3, COLUMN_FLOAT, KEPT, .needed = wide},
    {0},
};

bool columns_wide(const WorldDef *def)
{
    double widest = 0;
    for (int k = 0; k < def->dimensions; k++)
        widest = def->box_size[k] > widest ? def->box_size[k] : widest;
    return widest > COLUMNS_WIDE * def->spacing;
}

static void add_rows(ColumnRows *rows, const ColumnDef *from, unsigned flags,
                     const struct Constants *constants)
{
    for (; from && from->name && rows->count < COLUMNS_MAX; from++)
        if ((from->flags & flags) == flags && (!constants || !from->needed || from->needed(constants)))
            rows->row[rows->count++] = from;
}

ColumnRows columns_saved(const WorldDef *def)
{
    ColumnRows rows = {0};
    add_rows(&rows, columns_common, COLUMN_SAVED, NULL);
    if (columns_wide(def))
        add_rows(&rows, columns_left, COLUMN_SAVED, NULL);
    add_rows(&rows, method_find(def->method)->columns, COLUMN_SAVED, NULL);
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->named(def))
            add_rows(&rows, (*term)->columns, COLUMN_SAVED, NULL);
    return rows;
}

uint32_t columns_scalars(const WorldDef *def)
{
    const ColumnRows saved = columns_saved(def);
    const Backend *backend = backend_find(def->backend);
    uint32_t scalars = backend ? backend->scalars : 0;
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (s < SCALAR_OWN || columns_place(&saved, (Scalar)s) >= 0)
            scalars |= UINT32_C(1) << s;
    return scalars;
}

ColumnRows column_rows(const ColumnDef *own, unsigned flags, const struct Constants *constants)
{
    ColumnRows rows = {0};
    add_rows(&rows, columns_common, flags, constants);
    add_rows(&rows, columns_left, flags, constants);
    add_rows(&rows, own, flags, constants);
    for (const Term *const *term = shared_terms; *term; term++)
        add_rows(&rows, (*term)->columns, flags, constants);
    return rows;
}

int column_own(const ColumnDef *column)
{
    return column->at < COLUMN_OWN(0) || column->at >= COLUMN_TERM(0)
               ? -1
               : (int)((column->at - COLUMN_OWN(0)) / sizeof(float *));
}

bool columns_save_own(const ColumnDef *own)
{
    while (own && own->name && (own->needed || !(own->flags & COLUMN_SAVED) || column_own(own) < 0))
        own++;
    return own && own->name;
}

enum { COLUMN_NAME_SIZE = 32 };

/* Name of the scalar for a component of a method's column: NAME, or NAME_x, NAME_y, NAME_z for three
   components. */
static void column_scalar_name(const ColumnDef *column, int component, char name[COLUMN_NAME_SIZE])
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

/* Sets multipliers from the pressure of the initial state. */
static void set_multipliers(const ParticleColumns *to, const Constants *constants,
                            const InitialState *initial)
{
    const Method *method = constants->method;
    float *multiplier = to->own[column_own(method->multiplier)];
    const double per = method->pressure_of_multiplier(constants);
    for (size_t i = 0; i < initial->count; i++)
        multiplier[i] = (float)((double)initial->pressure[i] / per);
}

void particles_set(const ParticleColumns *to, const Constants *constants, const InitialState *initial)
{
    for (size_t i = 0; i < initial->count; i++) {
        to->x[i] = initial->position[3 * i];
        to->y[i] = initial->position[3 * i + 1];
        to->z[i] = initial->position[3 * i + 2];
        to->id[i] = i;
        to->fluid[i] = initial->fluid ? initial->fluid[i] : 0;
        if (to->compression && initial->density)
            to->compression[i] = (float)(initial->density[i] / (double)constants->density[to->fluid[i]] - 1);
        if (!initial->velocity)
            continue;
        to->vx[i] = initial->velocity[3 * i];
        to->vy[i] = initial->velocity[3 * i + 1];
        to->vz[i] = initial->velocity[3 * i + 2];
    }
    if (initial->pressure && constants->method->multiplier)
        set_multipliers(to, constants, initial);
}

static float scalar_of(const ParticleColumns *p, const Constants *constants, Scalar scalar, size_t i)
{
    switch (scalar) {
    case SCALAR_SPEED:
        return sqrtf(p->vx[i] * p->vx[i] + p->vy[i] * p->vy[i] + p->vz[i] * p->vz[i]);
    case SCALAR_DENSITY:
        return constants->density[p->fluid[i]] * (1 + particle_compression(p, constants, i));
    case SCALAR_PRESSURE:
        return p->pressure[i];
    case SCALAR_COMPRESSION:
        return particle_compression(p, constants, i);
    case SCALAR_FLUID:
        return (float)p->fluid[i];
    case SCALAR_ID:
        return (float)p->id[i];
    default:
        return 0;
    }
}

/* NULL: the state has no such column. */
static const float *own_of(const ParticleColumns *p, const Constants *constants, Scalar scalar)
{
    const ColumnRows saved = column_rows(constants->method->columns, COLUMN_SAVED, constants);
    const int place = columns_place(&saved, scalar);
    return place < 0 ? NULL : p->own[place];
}

static void read_own(const float *own, const uint32_t *at, size_t begin, size_t end, float *out)
{
    for (size_t k = begin; k < end; k++)
        out[k] = own ? own[at ? at[k] : k] : NAN;
}

void particles_read(const ParticleColumns *p, const Constants *constants, const uint32_t *at, size_t begin,
                    size_t end, const ParticleArrays *out)
{
    for (size_t k = begin; k < end; k++) {
        const size_t i = at ? at[k] : k;
        if (out->position) {
            float *x = out->position + 4 * k;
            x[0] = p->x[i], x[1] = p->y[i], x[2] = p->z[i],
            x[3] = p->volume[i] * (float)constants->unit_volume;
        }
        if (out->velocity) {
            float *v = out->velocity + 4 * k;
            v[0] = p->vx[i], v[1] = p->vy[i], v[2] = p->vz[i], v[3] = 0;
        }
        if (out->fluid)
            out->fluid[k] = p->fluid[i];
        if (out->id)
            out->id[k] = (uint32_t)p->id[i];
        if (out->whole_id)
            out->whole_id[k] = p->id[i];
    }
    for (int s = 0; s < SCALAR_OWN; s++)
        for (size_t k = begin; out->scalar[s] && k < end; k++)
            out->scalar[s][k] = scalar_of(p, constants, (Scalar)s, at ? at[k] : k);
    for (int s = SCALAR_OWN; s < SCALAR_STATE_COUNT; s++)
        if (out->scalar[s])
            read_own(own_of(p, constants, (Scalar)s), at, begin, end, out->scalar[s]);
    for (int c = 0; c < COLUMNS_OWN; c++)
        for (size_t k = begin; out->own[c] && p->own[c] && k < end; k++)
            out->own[c][k] = p->own[c][at ? at[k] : k];
}

void particles_sums(const ParticleColumns *p, const Constants *constants, size_t count, WorldSums *sums)
{
    *sums = (WorldSums){0};
    for (size_t i = 0; i < count; i++) {
        const double x[3] = {p->x[i], p->y[i], p->z[i]}, v[3] = {p->vx[i], p->vy[i], p->vz[i]};
        sums_add(sums, constants_mass(constants, p->fluid[i]), x, v);
    }
    for (int k = 0; k < 3 && count > 0; k++)
        sums->centre[k] /= sums->mass;
}
