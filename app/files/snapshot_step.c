/* The arrays of a state in memory. */
#include "app/files/snapshot.h"

#include "app/files/snapshot_private.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void snapshot_step_free(SnapshotStep *step)
{
#define X(name, type, field) free(step->field);
    SNAPSHOT_FIELDS(X)
#undef X
    free(step->born);
    for (int k = 0; k < step->own_count; k++)
        free(step->own[k].values);
    for (int k = 0; k < step->shown_count; k++)
        free(step->shown[k].values);
    *step = (SnapshotStep){0};
}

void snapshot_floating(const SnapshotStep *step, BoxState floating[SOLIDS_MAX])
{
    for (int k = 0; k < SOLIDS_MAX; k++)
        floating[k] = step->restart.bodies.of[k].pose;
}

bool snapshot_step_allocate(SnapshotStep *step, size_t count)
{
    size_t some = count ? count : 1;
    bool all = true;
    *step = (SnapshotStep){.count = count};
#define X(name, type, field)                                                                                 \
    step->field = calloc(some, sizeof(type));                                                                \
    all = all && step->field;
    SNAPSHOT_FIELDS(X)
#undef X
    if (!all)
        snapshot_step_free(step);
    return all;
}

/* Adds the datasets of a column; three components are NAME_0, NAME_1, NAME_2, like the velocity. */
static bool add_own(SnapshotStep *step, const ColumnDef *column, size_t some)
{
    const int first = column_own(column);
    bool all = true;
    for (int c = 0; c < column->components; c++) {
        const int k = step->own_count++;
        snprintf(step->own[k].name, sizeof step->own[k].name, column->components > 1 ? "%s_%d" : "%s",
                 column->name, c);
        step->own[k].place = first + c;
        all &= (step->own[k].values = calloc(some, sizeof(float))) != NULL;
    }
    return all;
}

bool snapshot_step_allocate_method_columns(SnapshotStep *step, const ColumnRows *saved)
{
    bool all = true;
    for (int k = 0; k < saved->count; k++)
        if (column_own(saved->row[k]) >= 0)
            all &= add_own(step, saved->row[k], step->count ? step->count : 1);
    return all;
}

bool snapshot_step_allocate_births(SnapshotStep *step)
{
    step->born = calloc(step->count ? step->count : 1, sizeof *step->born);
    return step->born != NULL;
}

float *snapshot_step_allocate_scalar(SnapshotStep *step, Scalar scalar)
{
    float *values = calloc(step->count ? step->count : 1, sizeof *values);
    if (!values)
        return NULL;
    step->shown[step->shown_count].scalar = scalar;
    return step->shown[step->shown_count++].values = values;
}

const float *snapshot_step_scalar(const SnapshotStep *step, Scalar scalar)
{
    for (int k = 0; k < step->shown_count; k++)
        if (step->shown[k].scalar == scalar)
            return step->shown[k].values;
    return NULL;
}

double snapshot_volume(const SnapshotScene *scene, const SnapshotStep *step, size_t i)
{
    const bool known = step->fluid[i] >= 0 && (size_t)step->fluid[i] < scene->fluid_count;
    const double relative = known ? step->density[i] / scene->density[step->fluid[i]] : NAN;
    const double number = 1 + (relative - 1) / scene->stiffness_scale;
    return pow(scene->spacing, scene->dimensions) / (number < 0.05 ? 0.05 : number);
}

const char *snapshot_frame_name(SnapshotFrame frame)
{
    static const char *const names[] = {
#define X(NAME, name) name,
        SNAPSHOT_FRAMES(X)
#undef X
    };
    return names[frame];
}

bool snapshot_step_misses(const SnapshotStep *step, const char *name)
{
    unsigned field = 0, lacks = 0;
#define X(own, type, field_of)                                                                               \
    lacks |= strcmp(own, name) == 0 ? step->lacks & 1U << field : 0;                                         \
    field++;
    SNAPSHOT_FIELDS(X)
#undef X
    return lacks != 0;
}

void snapshot_step_to_world(SnapshotStep *step)
{
    for (size_t i = 0; i < step->count; i++) {
        double x[3], v[3], x_world[3], v_world[3];
        for (int k = 0; k < 3; k++) {
            x[k] = step->position[k][i];
            v[k] = step->velocity[k][i];
        }
        box_to_world(&step->box, x, v, x_world, v_world);
        for (int k = 0; k < 3; k++) {
            step->position[k][i] = (float)x_world[k];
            step->velocity[k][i] = (float)v_world[k];
        }
    }
}

/* The worst flaw of particle i; SNAPSHOT_FLAW_COUNT: none. `dense`: the file has densities. */
static SnapshotFlaw flaw_of(const SnapshotFlaws *flaws, const SnapshotStep *step, bool dense, size_t i)
{
    bool finite = isfinite(step->pressure[i]);
    for (int k = 0; k < 3; k++) {
        const double place = step->position[k][i];
        if (!isfinite(place) || fabs(place) > flaws->farthest)
            return SNAPSHOT_FLAW_POSITION;
        finite = finite && isfinite(step->velocity[k][i]);
    }
    if (step->fluid[i] < 0 || (size_t)step->fluid[i] >= flaws->fluids)
        return SNAPSHOT_FLAW_FLUID;
    if (dense && (!(step->density[i] > 0) || !isfinite(step->density[i])))
        return SNAPSHOT_FLAW_DENSITY;
    return finite ? SNAPSHOT_FLAW_COUNT : SNAPSHOT_FLAW_NUMBER;
}

static bool is_left_out(const SnapshotFlaws *flaws, SnapshotFlaw flaw)
{
    return flaw == SNAPSHOT_FLAW_POSITION || (flaws->strict && flaw < SNAPSHOT_FLAW_ID);
}

static void move(SnapshotStep *step, size_t from, size_t to)
{
#define X(name, type, field) step->field[to] = step->field[from];
    SNAPSHOT_FIELDS(X)
#undef X
    for (int k = 0; k < step->shown_count; k++)
        step->shown[k].values[to] = step->shown[k].values[from];
}

static int by_value(const void *a, const void *b)
{
    const int64_t one = *(const int64_t *)a, other = *(const int64_t *)b;
    return (one > other) - (one < other);
}

static bool count_ids(const SnapshotStep *step, size_t *repeated)
{
    int64_t *ids = malloc((step->count + 1) * sizeof *ids);
    if (!ids)
        return false;
    memcpy(ids, step->id, step->count * sizeof *ids);
    qsort(ids, step->count, sizeof *ids, by_value);
    for (size_t i = 1; i < step->count; i++)
        *repeated += ids[i] == ids[i - 1];
    free(ids);
    return true;
}

bool snapshot_validate(SnapshotFlaws *flaws, size_t index, SnapshotStep *step)
{
    const bool dense = !snapshot_step_misses(step, "density");
    size_t found[SNAPSHOT_FLAW_COUNT + 1] = {0}, kept = 0;
    flaws->dense = dense;
    for (size_t i = 0; i < step->count; i++) {
        const SnapshotFlaw flaw = flaw_of(flaws, step, dense, i);
        found[flaw]++;
        if (!is_left_out(flaws, flaw))
            move(step, i, kept++);
    }
    step->count = kept;
    if (!flaws->shown && !count_ids(step, &found[SNAPSHOT_FLAW_ID]))
        return false;
    for (int flaw = 0; flaw < SNAPSHOT_FLAW_COUNT; flaw++) {
        if (found[flaw] > 0 && flaws->of[flaw].snapshots++ == 0)
            flaws->of[flaw].first = index;
        flaws->of[flaw].particles += found[flaw];
    }
    return true;
}

size_t snapshot_flaws_left_out(const SnapshotFlaws *flaws)
{
    size_t count = 0;
    for (int flaw = 0; flaw < SNAPSHOT_FLAW_COUNT; flaw++)
        count += is_left_out(flaws, (SnapshotFlaw)flaw) ? flaws->of[flaw].particles : 0;
    return count;
}

/* Prints the handling of a flaw's particles, as the end of a sentence. */
static void print_fate(const SnapshotFlaws *flaws, SnapshotFlaw flaw, FILE *file)
{
    const bool one = flaws->of[flaw].particles == 1;
    const bool light = flaw == SNAPSHOT_FLAW_DENSITY || (flaw == SNAPSHOT_FLAW_FLUID && flaws->dense);
    if (is_left_out(flaws, flaw))
        fputs("left out\n", file);
    else if (flaws->summed && light)
        fprintf(file, "%s nothing in the slice\n", one ? "it weighs" : "they weigh");
    else
        fprintf(file, "%s as %s in the file\n", flaws->shown ? "shown" : "exported",
                one ? "it is" : "they are");
}

void snapshot_flaws_print(const SnapshotFlaws *flaws, const char *path, FILE *file)
{
    static const char *const words[] = {
        [SNAPSHOT_FLAW_POSITION] = "a position that is not finite or more than 100 boxes away",
        [SNAPSHOT_FLAW_FLUID] = "a fluid that the file does not know",
        [SNAPSHOT_FLAW_DENSITY] = "a density that is not more than 0",
        [SNAPSHOT_FLAW_NUMBER] = "a velocity or a pressure that is not finite",
        [SNAPSHOT_FLAW_ID] = "the id of another one",
    };
    _Static_assert(SNAPSHOT_FARTHEST_BOXES == 100, "the words say it");
    for (int flaw = 0; flaw < SNAPSHOT_FLAW_COUNT; flaw++) {
        const size_t particles = flaws->of[flaw].particles, snapshots = flaws->of[flaw].snapshots;
        if (particles == 0)
            continue;
        fprintf(file, "%s: warning: %zu particle%s ", path, particles, particles == 1 ? "" : "s");
        if (snapshots > 1)
            fprintf(file, "in %zu snapshots, the first of them ", snapshots);
        else
            fputs("of ", file);
        fprintf(file, "Step#%zu%s %s %s; ", flaws->of[flaw].first, snapshots > 1 ? "," : "",
                particles == 1 ? "has" : "have", words[flaw]);
        print_fate(flaws, (SnapshotFlaw)flaw, file);
    }
}

unsigned snapshot_attributes(const SnapshotStep *step)
{
    unsigned has = 0, lacks = 0;
#define X(name, source)                                                                                      \
    has |= (source);                                                                                         \
    lacks |= snapshot_step_misses(step, name) ? (source) : 0;
    SNAPSHOT_SOURCES(X)
#undef X
    for (int s = SCALAR_OWN; s < SCALAR_STATE_COUNT; s++)
        has |= snapshot_step_scalar(step, (Scalar)s) ? PARTICLE_SCALAR(s) : 0;
    return (has & ~lacks) | PARTICLE_FLUID; /* default: all particles are of the first fluid */
}

static double volume_of(const SnapshotScene *scene, const SnapshotStep *step, SnapshotVolume volume, size_t i)
{
    const int of = step->fluid[i];
    if (of < 0 || (size_t)of >= scene->fluid_count || !(step->density[i] > 0))
        return 0;
    return volume == SNAPSHOT_VOLUME
               ? snapshot_volume(scene, step, i)
               : scene->density[of] * pow(scene->spacing, scene->dimensions) / step->density[i];
}

static void fill_places(const SnapshotScene *scene, const SnapshotStep *step, SnapshotVolume volume,
                        float *position)
{
    const double at_rest = pow(scene->spacing, scene->dimensions);
    const bool dense = !snapshot_step_misses(step, "density");
    for (size_t i = 0; i < step->count; i++) {
        for (size_t k = 0; k < 3; k++)
            position[4 * i + k] = step->position[k][i];
        position[4 * i + 3] = (float)(dense ? volume_of(scene, step, volume, i) : at_rest);
    }
}

static void fill_velocities(const SnapshotStep *step, float *velocity)
{
    for (size_t i = 0; i < step->count; i++) {
        for (size_t k = 0; k < 3; k++)
            velocity[4 * i + k] = step->velocity[k][i];
        velocity[4 * i + 3] = 0;
    }
}

static float scalar_of(const SnapshotStep *step, Scalar scalar, size_t i)
{
    const float *const *v = (const float *const *)step->velocity;
    switch (scalar) {
    case SCALAR_SPEED: /* the same bits as sim/step/columns.c */
        return sqrtf(v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i]);
    case SCALAR_DENSITY:
        return step->density[i];
    case SCALAR_PRESSURE:
        return step->pressure[i];
    case SCALAR_COMPRESSION:
        return step->compression[i];
    case SCALAR_FLUID:
        return (float)step->fluid[i];
    case SCALAR_ID:
        return (float)(uint32_t)step->id[i];
    default:
        return NAN;
    }
}

static void fill_own(const SnapshotStep *step, Scalar scalar, float *to)
{
    const float *own = snapshot_step_scalar(step, scalar);
    for (size_t i = 0; i < step->count; i++)
        to[i] = own ? own[i] : NAN;
}

void snapshot_arrays(const SnapshotScene *scene, const SnapshotStep *step, SnapshotVolume volume,
                     const ParticleArrays *to)
{
    if (to->position)
        fill_places(scene, step, volume, to->position);
    if (to->velocity)
        fill_velocities(step, to->velocity);
    for (size_t i = 0; to->fluid && i < step->count; i++)
        to->fluid[i] = (uint32_t)step->fluid[i];
    for (size_t i = 0; to->id && i < step->count; i++)
        to->id[i] = (uint32_t)step->id[i];
    for (size_t s = 0; s < SCALAR_OWN; s++)
        for (size_t i = 0; to->scalar[s] && i < step->count; i++)
            to->scalar[s][i] = scalar_of(step, (Scalar)s, i);
    for (int s = SCALAR_OWN; s < SCALAR_STATE_COUNT; s++)
        if (to->scalar[s])
            fill_own(step, (Scalar)s, to->scalar[s]);
}

void snapshot_buffers_destroy(SnapshotBuffers *buffers)
{
    if (buffers->upload) {
        derived_destroy(&buffers->derived);
        upload_destroy(buffers->upload);
    }
    *buffers = (SnapshotBuffers){0};
}

/* Births come from the file, so need no ids. */
unsigned snapshot_scalar_attributes(Scalar scalar)
{
    const ParticleWants wants = {.scalars = SCALAR_BIT(scalar)};
    return (int)scalar < SCALAR_STATE_COUNT ? PARTICLE_SCALAR(scalar)
                                            : particle_wants_attributes(&wants) & ~PARTICLE_ID;
}

static void free_arrays(ParticleArrays *arrays)
{
    free(arrays->position);
    free(arrays->velocity);
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        free(arrays->scalar[s]);
}

/* `attributes`: PARTICLE_*. */
static bool make_arrays(ParticleArrays *arrays, unsigned attributes, size_t count)
{
    const bool moves = attributes & PARTICLE_VELOCITY;
    arrays->position = calloc(count + 1, sizeof(float[4]));
    arrays->velocity = moves ? calloc(count + 1, sizeof(float[4])) : NULL;
    bool made = arrays->position && (arrays->velocity || !moves);
    for (int s = 0; s < SCALAR_STATE_COUNT; s++)
        if (attributes & PARTICLE_SCALAR(s))
            made = (arrays->scalar[s] = calloc(count + 1, sizeof(float))) && made;
    return made;
}

static ParticleBuffers state_of(const SnapshotScene *scene, const SnapshotStep *step)
{
    ParticleBuffers state = {.count = step->count,
                             .spacing = scene->spacing,
                             .support_radius = scene->support_radius,
                             .box = step->box,
                             .time = step->time};
    snapshot_floating(step, state.floating);
    memcpy(state.box_size, scene->box_size, sizeof state.box_size);
    return state;
}

/* Makes buffers for at least `count` particles, with a margin, as counts in a series may grow. `attributes`:
   PARTICLE_*. */
static bool follow_count(SnapshotBuffers *buffers, size_t count, unsigned attributes, Error *error)
{
    if (buffers->upload && count <= buffers->capacity)
        return true;
    upload_destroy(buffers->upload);
    buffers->capacity = count + count / 2 + 1;
    buffers->upload = upload_create(buffers->capacity, attributes, error);
    return buffers->upload != NULL;
}

static bool derive(Derived *derived, const ParticleWants *wants, const SnapshotScene *scene, Scalar scalar,
                   ParticleBuffers *buffers, Error *error)
{
    DerivedSpace space = {.flat = scene->dimensions == 2};
    memcpy(space.periodic, scene->periodic, sizeof space.periodic);
    if (!derived_update(derived, wants, error))
        return false;
    derived_fill(derived, wants, &space, buffers);
    return buffers->count == 0 || buffers->scalar[scalar].buffer ||
           error_set(error, "the GPU has no memory for %s",
                     derived->lacks ? derived->lacks : scalar_name(scalar));
}

bool snapshot_buffers_make(SnapshotBuffers *buffers, const SnapshotScene *scene, const SnapshotStep *step,
                           SnapshotVolume volume, Scalar scalar, ParticleBuffers *out, Error *error)
{
    const ParticleWants wants = {.scalars = SCALAR_BIT(scalar)};
    const ParticleBuffers state = state_of(scene, step);
    const unsigned attributes = snapshot_scalar_attributes(scalar);
    ParticleArrays arrays = {0};
    bool made =
        make_arrays(&arrays, attributes, step->count) || error_set(error, "out of memory for the particles");
    if (made)
        snapshot_arrays(scene, step, volume, &arrays);
    made = made && follow_count(buffers, step->count, attributes, error) &&
           upload_write_arrays(buffers->upload, &arrays, &state, error) &&
           upload_take(buffers->upload, out) && derive(&buffers->derived, &wants, scene, scalar, out, error);
    free_arrays(&arrays);
    return made;
}

static void read_scalar(const ParticleAttribute *from, size_t count, float *values)
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(from->buffer, (GLintptr)from->offset, (GLsizeiptr)(count * sizeof *values),
                            values);
}

bool snapshot_buffers_scalar(SnapshotBuffers *buffers, const SnapshotScene *scene, const SnapshotStep *step,
                             Scalar scalar, float *values, Error *error)
{
    ParticleArrays arrays = {0};
    ParticleBuffers made;
    if ((int)scalar < SCALAR_STATE_COUNT) {
        arrays.scalar[scalar] = values;
        snapshot_arrays(scene, step, SNAPSHOT_VOLUME, &arrays);
        return true;
    }
    if (!snapshot_buffers_make(buffers, scene, step, SNAPSHOT_VOLUME, scalar, &made, error))
        return false;
    read_scalar(&made.scalar[scalar], step->count, values);
    return true;
}
