/* The particles' columns in storage buffers: layout and transfer both ways. */
#include "sim/world/particles.h"
#include "sim/gl/compute/compute.h"
#include "sim/gl/packing.h"

#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

enum { POSITION = 1, VELOCITY, NAME, MOVED, PRESSURE = MOVED, BUFFERS };

#define AT(member) offsetof(ParticleColumns, member)

static const Packing packing = {.words = {[POSITION] = 4, [VELOCITY] = 4, [NAME] = 2, [PRESSURE] = 2},
                                .column = {
                                    {POSITION, 0, AT(x), COLUMN_FLOAT},
                                    {POSITION, 3, AT(volume), COLUMN_FLOAT},
                                    {VELOCITY, 0, AT(vx), COLUMN_FLOAT},
                                    {VELOCITY, 3, AT(compression), COLUMN_FLOAT},
                                    {NAME, 0, AT(id), COLUMN_INDEX},
                                    {NAME, 1, AT(fluid), COLUMN_INDEX},
                                    {PRESSURE, 0, AT(pressure), COLUMN_FLOAT},
                                    {PRESSURE, 1, AT(pressure_term), COLUMN_FLOAT},
                                }};

/* Buffers moved by the sort: from POSITION to before MOVED. */
static const struct {
    const char *label;
    size_t at; /* offset in ComputeParticles */
} moved[MOVED] = {
    [POSITION] = {"particle positions", offsetof(ComputeParticles, position)},
    [VELOCITY] = {"particle velocities", offsetof(ComputeParticles, velocity)},
    [NAME] = {"particle ids and fluids", offsetof(ComputeParticles, name)},
};

static size_t entry_bytes(int buffer)
{
    return 4 * (size_t)packing.words[buffer];
}

static unsigned *moved_in(ComputeParticles *particles, int buffer)
{
    return (unsigned *)(void *)((char *)particles + moved[buffer].at);
}

static unsigned buffer_of(const Compute *c, int buffer)
{
    ComputeParticles now = c->now;
    return buffer == PRESSURE ? c->pressure : *moved_in(&now, buffer);
}

bool compute_particles_create(Compute *c, ComputeParticles *particles, Error *error)
{
    for (int b = POSITION; b < MOVED; b++)
        *moved_in(particles, b) = compute_buffer(c, moved[b].label, entry_bytes(b) * c->capacity);
    if (c->own.count > 0)
        particles->own =
            compute_buffer(c, "columns of the method's own", 4 * (size_t)c->own.count * c->capacity);
    return !c->full || compute_no_memory(c, error);
}

void compute_particles_destroy(ComputeParticles *particles)
{
    for (int b = POSITION; b < MOVED; b++)
        glDeleteBuffers(1, moved_in(particles, b));
    glDeleteBuffers(1, &particles->own);
}

void compute_particles_copy(const Compute *c, ComputeParticles from, ComputeParticles to)
{
    for (int b = POSITION; b < MOVED; b++)
        glCopyNamedBufferSubData(*moved_in(&from, b), *moved_in(&to, b), 0, 0,
                                 (GLsizeiptr)(entry_bytes(b) * c->count));
    compute_own_copy(c, from.own, to.own);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void compute_swap(Compute *c)
{
    const ComputeParticles other = c->spare;
    c->spare = c->now;
    c->now = other;
}

/* Uploads columns; volumes and missing columns become 0. */
static void upload(const Compute *c, const ParticleColumns *from, uint32_t *entries)
{
    for (int b = POSITION; b < MOVED; b++) {
        memset(entries, 0, entry_bytes(b) * c->count);
        packing_pack(&packing, b, c->constants->method, from, c->count, NULL, entries);
        glNamedBufferSubData(buffer_of(c, b), 0, (GLsizeiptr)(entry_bytes(b) * c->count), entries);
    }
    compute_own_upload(c, from);
}

static void download(const Compute *c, const ParticleColumns *to, uint32_t *entries)
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    for (int b = POSITION; b < BUFFERS; b++) {
        glGetNamedBufferSubData(buffer_of(c, b), 0, (GLsizeiptr)(entry_bytes(b) * c->count), entries);
        packing_unpack(&packing, b, c->constants->method, entries, c->count, to);
    }
    for (size_t i = 0; to->volume && i < c->count; i++) /* m3, for the views */
        to->volume[i] /= (float)c->constants->unit_volume;
    compute_own_download(c, to);
}

/* Memory for the largest entries of `count` particles. */
static uint32_t *entries_create(size_t count)
{
    return malloc(4 * PACKED_WORDS * (count + 1));
}

static ColumnRows rows_of(const Compute *c)
{
    ColumnRows rows = packing_rows(&packing, c->constants->method);
    compute_own_rows(c, &rows);
    return rows;
}

bool compute_download(const Compute *c, ParticleColumns *columns)
{
    const ColumnRows rows = rows_of(c);
    uint32_t *entries = entries_create(c->count);
    *columns = (ParticleColumns){0};
    const bool done = entries && columns_create(columns, &rows, c->count, NULL);
    if (done)
        download(c, columns, entries);
    else
        columns_destroy(columns);
    free(entries);
    return done;
}

bool compute_set_particles(Compute *c, const InitialState *initial)
{
    const ColumnRows rows = rows_of(c);
    ParticleColumns columns = {0};
    uint32_t *entries = entries_create(c->count);
    const bool done = entries && columns_create(&columns, &rows, c->count, NULL);
    if (done) {
        particles_set(&columns, c->constants, initial);
        upload(c, &columns, entries);
    }
    columns_destroy(&columns);
    free(entries);
    return done;
}

bool compute_save(void *state, const ParticleColumns *to)
{
    const Compute *c = state;
    uint32_t *entries = entries_create(c->count);
    if (entries)
        download(c, to, entries);
    free(entries);
    return entries != NULL;
}

bool compute_load(void *state, const ParticleColumns *from, size_t count, size_t guarded)
{
    Compute *c = state;
    uint32_t *entries = count > c->capacity ? NULL : entries_create(count);
    if (!entries)
        return false;
    compute_set_count(c, count);
    upload(c, from, entries);
    free(entries);
    compute_watch_reset(c, guarded);
    return true;
}
