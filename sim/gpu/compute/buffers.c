#include "sim/gpu/compute/compute.h"

#include "shaders/sim/bindings.h"
#include "shaders/sim/watch_block.h"
#include "sim/gpu/gl.h"
#include "sim/gpu/packing.h"
#include "sim/step/backend.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Columns kept per particle by a method and by terms of the scene: a storage buffer with all columns in
   sequence, each with room for `capacity` numbers. A second buffer holds the shaders' scratch. Read by
   shaders/sim/own.glsl and scratch.glsl. */

static bool kept(const ColumnDef *column)
{
    return column_own(column) >= 0 && column->flags & (COLUMN_SAVED | COLUMN_SORTED);
}

/* The buffer never shrinks: older programs, with more columns, may still use it. */
bool compute_scratch_fit(Compute *c)
{
    const int total = compute_scratch_of(c->constants).total;
    if (total <= c->scratch_total)
        return true;
    const unsigned buffer = compute_buffer(c, "scratch of the method's own", 4 * (size_t)total * c->capacity);
    if (!buffer)
        return c->full = false;
    glDeleteBuffers(1, &c->scratch);
    c->scratch = buffer;
    c->scratch_total = total;
    return true;
}

static bool has_row(const ComputeOwn *own, const ColumnDef *column)
{
    for (int k = 0; k < own->rows.count; k++)
        if (own->rows.row[k] == column)
            return true;
    return false;
}

static void add_kept(const Constants *s, const ColumnDef *columns, const Term *of, ComputeOwn *own)
{
    for (; columns && columns->name; columns++)
        if (kept(columns) && (!columns->needed || columns->needed(s)) && !has_row(own, columns)) {
            own->of[own->rows.count] = of;
            own->rows.row[own->rows.count++] = columns;
            for (int k = 0; k < columns->components; k++)
                own->place[own->count++] = column_own(columns) + k;
        }
}

/* Appends what the constants ask for and `own` lacks. */
static void add_all(const Constants *s, ComputeOwn *own)
{
    add_kept(s, s->method->columns, NULL, own);
    if (s->wide)
        add_kept(s, columns_left, NULL, own);
    for (const Term *const *term = shared_terms; *term; term++)
        add_kept(s, (*term)->columns, *term, own);
}

ComputeOwn compute_own_of(const Constants *s)
{
    ComputeOwn own = {0};
    add_all(s, &own);
    return own;
}

static bool widen(Compute *c, unsigned *buffer, int before, int count)
{
    const unsigned wider = compute_buffer(c, "columns of the method's own", 4 * (size_t)count * c->capacity);
    if (!wider)
        return c->full = false;
    if (*buffer && before > 0)
        compute_copy(c, *buffer, wider, 0, 4 * (size_t)before * c->capacity);
    glDeleteBuffers(1, buffer);
    *buffer = wider;
    return true;
}

/* New columns follow the present columns. */
bool compute_own_fit(Compute *c)
{
    ComputeOwn own = c->own;
    const int before = own.count;
    add_all(c->constants, &own);
    if (own.count == before)
        return true;
    if (!widen(c, &c->now.own, before, own.count) || !widen(c, &c->spare.own, before, own.count) ||
        (c->marked.position && !widen(c, &c->marked.own, before, own.count)))
        return false;
    c->own = own;
    return true;
}

/* appends the columns */
static void compute_own_rows(const Compute *c, ColumnRows *rows)
{
    for (int k = 0; k < c->own.rows.count; k++)
        rows->row[rows->count++] = c->own.rows.row[k];
}

/* Defines the index of a column's first component in its buffer; for a term, with the term's name as
   prefix. */
static void define(const Compute *c, const char *buffer, const Term *of, const ColumnDef *column, size_t *at,
                   char out[COMPUTE_DEFINES_MAX])
{
    const size_t used = strlen(out);
    snprintf(out + used, COMPUTE_DEFINES_MAX - used, "#define %s_%s%s%s %zuu\n", buffer, of ? of->name : "",
             of ? "_" : "", column->name, *at * c->capacity);
    *at += (size_t)column->components;
}

void compute_own_defines(const Compute *c, char out[COMPUTE_DEFINES_MAX])
{
    const ComputeScratch scratch = compute_scratch_of(c->constants);
    size_t own = 0, at = 0;
    for (int k = 0; k < c->own.rows.count; k++)
        define(c, "OWN", c->own.of[k], c->own.rows.row[k], &own, out);
    for (int k = 0; k < scratch.count; k++)
        define(c, "SCRATCH", scratch.of[k], scratch.row[k], &at, out);
    const size_t used = strlen(out);
    if (own + at > 0)
        snprintf(out + used, COMPUTE_DEFINES_MAX - used, "#define OWN_TOTAL %zuu\n#define OWN_STRIDE %zuu\n",
                 own, c->capacity);
}

/* Offset of entry i of the k-th column, bytes. */
static GLintptr place_of(const Compute *c, int k, size_t i)
{
    return (GLintptr)(4 * ((size_t)k * c->capacity + i));
}

/* Missing columns become 0; `zeros`: `count` numbers. */
static void compute_own_upload(const Compute *c, const ParticleColumns *from, const uint32_t *zeros)
{
    for (int k = 0; k < c->own.count; k++) {
        const float *column = from->own[c->own.place[k]];
        glNamedBufferSubData(c->now.own, place_of(c, k, 0), (GLsizeiptr)(4 * c->count),
                             column ? (const void *)column : zeros);
    }
}

static void compute_own_download(const Compute *c, const ParticleColumns *to)
{
    for (int k = 0; k < c->own.count; k++)
        if (to->own[c->own.place[k]])
            glGetNamedBufferSubData(c->now.own, place_of(c, k, 0), (GLsizeiptr)(4 * c->count),
                                    to->own[c->own.place[k]]);
}

static void compute_own_copy(Compute *c, unsigned from, unsigned to)
{
    for (int k = 0; k < c->own.count; k++)
        compute_copy(c, from, to, (size_t)place_of(c, k, 0), 4 * c->count);
}

void compute_own_copy_one(const Compute *c, int k, unsigned to)
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    if (c->count > 0)
        glCopyNamedBufferSubData(c->now.own, to, place_of(c, k, 0), 0, (GLsizeiptr)(4 * c->count));
}

void compute_own_move(Compute *c, unsigned order)
{
    if (c->own.count == 0)
        return;
    BIND([ORDERS_BUFFER] = order, [OLD_OWN_BUFFER] = c->now.own, [OWN_BUFFER] = c->spare.own);
    compute_run(c, COMPUTE_OWN_MOVE, c->count);
}

void compute_own_gather(Compute *c, unsigned marks)
{
    if (c->own.count == 0)
        return;
    BIND([MARKS_BUFFER] = marks, [OLD_OWN_BUFFER] = c->now.own, [OWN_BUFFER] = c->spare.own);
    compute_run(c, COMPUTE_OWN_GATHER, c->count);
}

/* The particles' columns in storage buffers: layout and transfer both ways. */

enum { POSITION = 1, VELOCITY, NAME, MOVED, PRESSURE = MOVED, BUFFERS };

#define AT(member) offsetof(ParticleColumns, member)

static const ColumnPacking packing = {.words = {[POSITION] = 4, [VELOCITY] = 4, [NAME] = 2, [PRESSURE] = 2},
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

void compute_particles_copy(Compute *c, ComputeParticles from, ComputeParticles to)
{
    for (int b = POSITION; b < MOVED; b++)
        compute_copy(c, *moved_in(&from, b), *moved_in(&to, b), 0, entry_bytes(b) * c->count);
    compute_own_copy(c, from.own, to.own);
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
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    for (int b = POSITION; b < MOVED; b++) {
        memset(entries, 0, entry_bytes(b) * c->count);
        packing_pack(&packing, b, c->constants->method, from, c->count, NULL, entries);
        glNamedBufferSubData(buffer_of(c, b), 0, (GLsizeiptr)(entry_bytes(b) * c->count), entries);
    }
    memset(entries, 0, 4 * c->count);
    compute_own_upload(c, from, entries);
}

static void download(const Compute *c, const ParticleColumns *to, uint32_t *entries)
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    for (int b = POSITION; b < BUFFERS; b++) {
        if (!packing_has(&packing, b, c->constants->method, to))
            continue;
        glGetNamedBufferSubData(buffer_of(c, b), 0, (GLsizeiptr)(entry_bytes(b) * c->count), entries);
        packing_unpack(&packing, b, c->constants->method, entries, 0, c->count, to);
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

void compute_watch_reset(Compute *c, size_t guarded)
{
    static const WatchBlock nothing;
    glNamedBufferSubData(c->watch.buffer, 0, sizeof nothing, &nothing);
    mailbox_forget(&c->watch);
    c->watch_due = c->watch_here = false;
    c->longest = 0;
    c->guarded_before = guarded;
    c->guarded = 0;
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

/* A copy of the saved columns in memory shared by GPU and CPU. The world may go before the copy has been
   read. */
typedef struct ComputeCopy {
    Mailbox mailbox;
    bool arrived;
    const Method *method;
    ComputeOwn own;
    size_t count, done;            /* particles; read particles */
    size_t at[BUFFERS], at_column; /* bytes before a buffer's entries, before the method's first column */
} ComputeCopy;

enum { COPY_PART = 16384, COPY_PARTS = 32 }; /* particles read at once, at least; parts at most */

static void copy_free(void *copying)
{
    ComputeCopy *copy = copying;
    if (copy)
        mailbox_destroy(&copy->mailbox);
    free(copy);
}

/* Finds the places of the columns; returns the bytes. */
static size_t copy_layout(ComputeCopy *copy, const Compute *c, const ParticleColumns *to)
{
    size_t bytes = 0;
    copy->arrived = false;
    copy->method = c->constants->method;
    copy->own = c->own;
    copy->count = c->count;
    copy->done = 0;
    for (int b = POSITION; b < BUFFERS; b++) {
        copy->at[b] = bytes;
        bytes += packing_has(&packing, b, copy->method, to) ? entry_bytes(b) * c->count : 0;
    }
    copy->at_column = bytes;
    return bytes + 4 * (size_t)c->own.count * c->count;
}

static void copy_send(ComputeCopy *copy, const Compute *c, const ParticleColumns *to)
{
    const GLuint out = copy->mailbox.copy;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    for (int b = POSITION; b < BUFFERS; b++)
        if (packing_has(&packing, b, copy->method, to))
            glCopyNamedBufferSubData(buffer_of(c, b), out, 0, (GLintptr)copy->at[b],
                                     (GLsizeiptr)(entry_bytes(b) * c->count));
    for (int k = 0; k < c->own.count; k++)
        glCopyNamedBufferSubData(c->now.own, out, place_of(c, k, 0),
                                 (GLintptr)(copy->at_column + 4 * (size_t)k * c->count),
                                 (GLsizeiptr)(4 * c->count));
    mailbox_close(&copy->mailbox);
}

static bool copy_begin(void *state, const ParticleColumns *to, void **copying)
{
    Compute *c = state;
    ComputeCopy *copy = *copying ? *copying : calloc(1, sizeof *copy);
    *copying = copy;
    if (!copy)
        return false;
    const size_t bytes = copy_layout(copy, c, to);
    mailbox_forget(&copy->mailbox);
    if (bytes > copy->mailbox.bytes) {
        mailbox_destroy(&copy->mailbox);
        if (!mailbox_create_copy(&copy->mailbox, "saved particles", bytes)) {
            copy_free(copy);
            *copying = NULL;
            return false;
        }
    }
    copy->arrived = bytes == 0;
    if (bytes > 0)
        copy_send(copy, c, to);
    return true;
}

static void copy_read(const ComputeCopy *copy, size_t end, const ParticleColumns *to)
{
    const char *mapped = copy->mailbox.mapped;
    const size_t begin = copy->done;
    for (int b = POSITION; b < BUFFERS; b++)
        packing_unpack(&packing, b, copy->method, (const uint32_t *)(const void *)(mapped + copy->at[b]),
                       begin, end, to);
    for (int k = 0; k < copy->own.count; k++) {
        float *column = to->own[copy->own.place[k]];
        const float *from = (const float *)(const void *)(mapped + copy->at_column) + (size_t)k * copy->count;
        if (column)
            memcpy(column + begin, from + begin, (end - begin) * sizeof *column);
    }
}

static bool copy_go_on(void *copying, const ParticleColumns *to, bool waits, bool *whole)
{
    ComputeCopy *copy = copying;
    *whole = false;
    if (!copy->arrived) {
        const void *arrived = waits ? mailbox_wait(&copy->mailbox) : mailbox_look(&copy->mailbox);
        if (!arrived)
            return copy->mailbox.fence != NULL;
        copy->arrived = true;
    }
    const size_t left = copy->count - copy->done, least = copy->count / COPY_PARTS + 1;
    const size_t part = least > COPY_PART ? least : COPY_PART;
    const size_t end = waits || left < part ? copy->count : copy->done + part;
    copy_read(copy, end, to);
    copy->done = end;
    *whole = end == copy->count;
    return true;
}

const BackendCopy compute_copies = {copy_begin, copy_go_on, copy_free};

void compute_forces_forget(Compute *c)
{
    ComputeForces *forces = &c->forces;
    for (int k = 0; k < 2; k++) {
        mailbox_forget(&forces->sums[k]);
        forces->here[k] = NULL;
    }
    forces->taken = forces->sent;
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
    compute_forces_forget(c);
    return true;
}

/* Neighbour lists, made by the first pass of a step for later passes: shaders/sim/lists.glsl. Without a
   free binding or memory, and with periodic sides, each pass walks the cells. Lists take at most a quarter
   of the memory: the views need some, and a driver may promise more memory than there is. Where a driver's
   blocks are too small, lists take up to four. */

/* List size: half more than the lattice has within the support, plus 8, since moving fluid is locally
   denser. */
static size_t list_most(const Constants *s)
{
    const double r = (double)s->support_radius / (double)s->spacing, pi = 3.14159265358979;
    const double lattice = s->dimensions == 2 ? pi * r * r : 4.0 / 3.0 * pi * r * r * r;
    return 8 * (size_t)ceil((1.5 * lattice + 8) / 8);
}

/* Particles of each block, a multiple of 32. */
static size_t share_of(const Compute *c, int blocks)
{
    return (c->capacity / (size_t)blocks + 32) / 32 * 32;
}

/* True if the driver has enough bindings and blocks: solids and a method's columns need some beside the
   usual eight. */
static bool bound(const Compute *c, const GlLimits *have, int blocks)
{
    const int columns = (c->own.count > 0) + (compute_scratch_of(c->constants).total > 0);
    const int last = blocks > 1 ? MORE_LISTS_BUFFER + blocks - 2 : LISTS_BUFFER;
    return !c->constants->periodic.any && have->bindings > last &&
           have->compute_blocks >= 7 + blocks + columns + (c->constants->solid_count > 0 ? 5 : 0);
}

/* `bytes`: of a particle. */
static bool make_lists(Compute *c, const GlLimits *have, size_t bytes)
{
    int blocks = 1;
    while (blocks < COMPUTE_LISTS && (int64_t)(bytes * share_of(c, blocks)) > have->block_bytes)
        blocks++;
    const size_t block = bytes * share_of(c, blocks);
    if (!bound(c, have, blocks) || (int64_t)block > have->block_bytes ||
        (double)block * blocks > 0.25 * gl_memory())
        return false;
    for (int k = 0; k < blocks; k++)
        c->lists[k] = compute_buffer(c, "lists of neighbours", block);
    c->list_blocks = blocks;
    c->list_share = share_of(c, blocks);
    return !c->full;
}

void compute_lists_create(Compute *c)
{
    const GlLimits have = gl_limits();
    const size_t most = list_most(c->constants), bytes = 4 * (most + 1);
    if (c->full || !bound(c, &have, 1))
        return;
    c->list_most = most;
    c->unlisted = 0;
    if (!make_lists(c, &have, bytes)) {
        glDeleteBuffers(COMPUTE_LISTS, c->lists);
        memset(c->lists, 0, sizeof c->lists);
        c->unlisted = bytes * share_of(c, 1);
    }
    c->full = false;
}

void compute_list_defines(const Compute *c, char out[COMPUTE_DEFINES_MAX])
{
    const size_t used = strlen(out);
    if (!c->lists[0])
        return;
    snprintf(out + used, COMPUTE_DEFINES_MAX - used,
             "#define LISTS 1\n#define LIST_MOST %zuu\n#define LIST_STRIDE %zuu\n#define LIST_RUN %uu\n",
             c->list_most, c->list_share, gl_renderer_is_software() ? 1U : 4U);
    if (c->list_blocks > 1)
        snprintf(out + strlen(out), COMPUTE_DEFINES_MAX - strlen(out),
                 "#define LIST_BLOCKS %d\n#define LIST_SHARE %zuu\n", c->list_blocks, c->list_share);
}
