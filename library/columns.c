/* Columns of particles: read on the first call after a change of the state, and written by way of a saved
   state. */
#include "library/library.h"
#include "sim/base/base.h"
#include "sim/state.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Columns beside the scalars of a state. Position and volume share a buffer. */
enum { AT_POSITION = SCALAR_STATE_COUNT, AT_VELOCITY, AT_ID, AT_FLUID, AT_VOLUME };

typedef struct ColumnKind {
    int at; /* number in LIBRARY_COLUMNS */
    const char *name, *unit;
    int type, components;
    size_t stride; /* bytes */
    size_t skip;   /* bytes to the first component */
} ColumnKind;

static const ColumnKind kinds[] = {
    {AT_POSITION, "position", "m", SLOSH_FLOAT32, 3, 4 * sizeof(float), 0},
    {AT_VELOCITY, "velocity", "m/s", SLOSH_FLOAT32, 3, 4 * sizeof(float), 0},
    {AT_VOLUME, "volume", "m3", SLOSH_FLOAT32, 1, 4 * sizeof(float), 3 * sizeof(float)},
    {AT_ID, "id", "", SLOSH_UINT64, 1, sizeof(ParticleId), 0},
    {AT_FLUID, "fluid", "", SLOSH_UINT32, 1, sizeof(uint32_t), 0},
};

enum { KINDS = sizeof kinds / sizeof *kinds };

/* Scalars of the world's states; id and fluid are whole numbers above. */
static uint32_t scalars(const slosh_world *world)
{
    const uint32_t of_state =
        (1U << SCALAR_SPEED) | (1U << SCALAR_DENSITY) | (1U << SCALAR_PRESSURE) | (1U << SCALAR_COMPRESSION);
    return (of_state | columns_scalars(&world->run.scene.world)) &
           ~((1U << SCALAR_ID) | (1U << SCALAR_FLUID) | (1U << SCALAR_BORN) | (1U << SCALAR_LOST));
}

/* Returns false after the last column. */
static bool kind_at(const slosh_world *world, size_t index, ColumnKind *kind)
{
    if (index < KINDS) {
        *kind = kinds[index];
        return true;
    }
    index -= KINDS;
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (scalars(world) >> s & 1 && index-- == 0) {
            *kind = (ColumnKind){
                s, scalar_name((Scalar)s), scalar_unit((Scalar)s), SLOSH_FLOAT32, 1, sizeof(float), 0};
            return true;
        }
    return false;
}

const char *slosh_world_column_name(const slosh_world *world, size_t index)
{
    ColumnKind kind;
    return world && kind_at(world, index, &kind) ? kind.name : NULL;
}

/* ---- read ---- */

void library_changed(slosh_world *world)
{
    world->state++;
    world_info(world->run.world, &world->run.info);
}

/* Room for `bytes`; older memory stays, as the caller may hold its address. */
static bool reserve(LibraryBuffer *buffer, size_t bytes)
{
    if (buffer->bytes >= bytes)
        return true;
    void *data = calloc(1, bytes);
    LibraryBuffer *older = buffer->data ? malloc(sizeof *older) : NULL;
    if (!data || (buffer->data && !older)) {
        free(data);
        free(older);
        return false;
    }
    if (older)
        *older = *buffer;
    *buffer = (LibraryBuffer){.data = data, .bytes = bytes, .older = older};
    return true;
}

/* Brings the buffer of a column to the present state. */
static void *fresh(slosh_world *world, const ColumnKind *kind)
{
    LibraryBuffer *buffer = &world->columns[kind->at == AT_VOLUME ? AT_POSITION : kind->at];
    const WorldInfo *info = &world->run.info;
    const size_t most = info->capacity > info->count ? info->capacity : info->count;
    ParticleArrays out = {.position = NULL};
    if (buffer->state == world->state)
        return buffer->data;
    if (!reserve(buffer, (most + 1) * kind->stride))
        return NULL;
    if (kind->at == AT_POSITION || kind->at == AT_VOLUME)
        out.position = buffer->data;
    else if (kind->at == AT_VELOCITY)
        out.velocity = buffer->data;
    else if (kind->at == AT_ID)
        out.whole_id = buffer->data;
    else if (kind->at == AT_FLUID)
        out.fluid = buffer->data;
    else
        out.scalar[kind->at] = buffer->data;
    if (!world_read(world->run.world, &out))
        return NULL;
    buffer->state = world->state;
    return buffer->data;
}

const float *library_positions(slosh_world *world)
{
    return fresh(world, &kinds[0]);
}

/* Fails with the names that there are. */
static bool no_column(const slosh_world *world, const char *name, slosh_error *error)
{
    char names[600] = "";
    ColumnKind kind;
    for (size_t i = 0; kind_at(world, i, &kind); i++)
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i > 0 ? ", " : "", kind.name);
    return library_refuse(error, "%s: no such column; the world has %s", name ? name : "NULL", names);
}

bool slosh_world_column(slosh_world *world, const char *name, slosh_column *column, slosh_error *error)
{
    ColumnKind kind;
    size_t i = 0;
    if (!world || !column)
        return library_refuse(error, "the world or the column is NULL");
    if (column->size < sizeof *column)
        return library_refuse(error, "column.size is %zu; it must be sizeof(slosh_column), %zu", column->size,
                              sizeof *column);
    while (name && kind_at(world, i, &kind) && strcmp(kind.name, name) != 0)
        i++;
    if (!name || !kind_at(world, i, &kind))
        return no_column(world, name, error);
    const char *data = fresh(world, &kind);
    if (!data)
        return library_refuse(error, "no memory for the column %s", name);
    column->data = data + kind.skip;
    column->count = world->run.info.count;
    column->stride = kind.stride;
    column->components = kind.components;
    column->type = kind.type;
    column->unit = kind.unit;
    return true;
}

void library_columns_free(slosh_world *world)
{
    for (int i = 0; i < LIBRARY_COLUMNS; i++) {
        free(world->columns[i].data);
        for (LibraryBuffer *older = world->columns[i].older, *next; older; older = next) {
            next = older->older;
            free(older->data);
            free(older);
        }
    }
}

/* ---- write ---- */

typedef struct IdPlace {
    ParticleId id;
    size_t place;
} IdPlace;

static int ascending(const void *a, const void *b)
{
    const ParticleId x = ((const IdPlace *)a)->id, y = ((const IdPlace *)b)->id;
    return (x > y) - (x < y);
}

static IdPlace *sorted(const ParticleId *id, size_t count)
{
    IdPlace *order = malloc((count + 1) * sizeof *order);
    for (size_t i = 0; order && i < count; i++)
        order[i] = (IdPlace){id[i], i};
    if (order)
        qsort(order, count, sizeof *order, ascending);
    return order;
}

/* Rows of three numbers; NULL: nothing is written. */
typedef struct Rows {
    const char *data;
    size_t count, stride;
} Rows;

static void row_of(const Rows *rows, size_t i, float row[3])
{
    memcpy(row, rows->data + i * rows->stride, 3 * sizeof(float));
}

/* Checks the numbers of each particle. */
static bool are_sound(const Rows *rows, bool positions, const WorldDef *def, slosh_error *error)
{
    for (size_t i = 0; rows->data && i < rows->count; i++) {
        float row[3];
        row_of(rows, i, row);
        for (int k = 0; k < 3; k++) {
            const double low = k == 1 ? 0 : -0.5 * def->box_size[k], at = (double)row[k];
            if (!isfinite(at))
                return library_refuse(error, "particle %zu: %g is no finite number", i, at);
            if (positions && k < def->dimensions && !(at >= low && at <= low + def->box_size[k]))
                return library_refuse(error, "particle %zu: %c = %g m is outside the box, %g to %g m", i,
                                      "xyz"[k], at, low, low + def->box_size[k]);
            if (k >= def->dimensions && at != 0)
                return library_refuse(error, "particle %zu: z must be 0 in two dimensions, not %g", i, at);
        }
    }
    return true;
}

/* Puts row from[n] into the place into[n] of the columns. */
static void put(const Rows *rows, const IdPlace *from, const IdPlace *into, float *const column[3])
{
    for (size_t n = 0; rows->data && n < rows->count; n++) {
        float row[3];
        row_of(rows, from[n].place, row);
        for (int k = 0; k < 3; k++)
            column[k][into[n].place] = row[k];
    }
}

static bool write_rows(slosh_world *world, const Rows *position, const Rows *velocity, slosh_error *error)
{
    Error why = {"out of memory"};
    WorldState state = {.count = 0};
    const size_t count = world->run.info.count;
    const ParticleId *id = fresh(world, &kinds[3]);
    bool ok = id && world_save(world->run.world, &state, &why) && state.count == count;
    IdPlace *from = ok ? sorted(id, count) : NULL, *into = ok ? sorted(state.particles.id, count) : NULL;
    ok = from && into;
    if (ok) {
        const ParticleColumns *to = &state.particles;
        put(position, from, into, (float *const[]){to->x, to->y, to->z});
        put(velocity, from, into, (float *const[]){to->vx, to->vy, to->vz});
        ok = world_load(world->run.world, &state, &why);
    }
    free(from);
    free(into);
    world_state_free(&state);
    if (ok) {
        world->run.watch.closed = false;
        library_changed(world);
    }
    return ok || library_fail(error, &why);
}

bool slosh_world_write(slosh_world *world, const float *position, const float *velocity, size_t count,
                       size_t stride, slosh_error *error)
{
    if (!world)
        return library_refuse(error, "the world is NULL");
    const WorldDef *def = &world->run.scene.world;
    if (count != world->run.info.count)
        return library_refuse(error, "%zu rows, and the world has %zu particles", count,
                              world->run.info.count);
    if (stride != 0 && stride < 3 * sizeof(float))
        return library_refuse(error, "a stride of %zu bytes, and a row has 12", stride);
    const size_t step = stride ? stride : 3 * sizeof(float);
    const Rows x = {(const char *)position, count, step}, v = {(const char *)velocity, count, step};
    return are_sound(&x, true, def, error) && are_sound(&v, false, def, error) &&
           write_rows(world, &x, &v, error);
}
