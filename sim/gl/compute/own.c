/* Columns kept per particle by a method and by terms of the scene: a storage buffer with all columns in
   sequence, each with room for `capacity` numbers. A second buffer holds the shaders' scratch. Read by
   shaders/sim/own.glsl and scratch.glsl. */
#include "sim/gl/compute/compute.h"

#include "shaders/sim/bindings.h"

#include <epoxy/gl.h>
#include <stdio.h>
#include <string.h>

static bool kept(const ColumnDef *column)
{
    return column_own(column) >= 0 && column->flags & (COLUMN_SAVED | COLUMN_SORTED);
}

size_t compute_scratch_place(const Compute *c, const ColumnDef *column)
{
    const ComputeScratch scratch = compute_scratch_of(c->constants);
    size_t place = 0;
    for (int k = 0; scratch.row[k] != column; k++)
        place += (size_t)scratch.row[k]->components * c->capacity;
    return place;
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

static void add_kept(const Constants *s, const ColumnDef *columns, const Term *of, ComputeOwn *own)
{
    for (; columns && columns->name; columns++)
        if (kept(columns) && (!of || !columns->needed || columns->needed(s))) {
            own->of[own->rows.count] = of;
            own->rows.row[own->rows.count++] = columns;
            for (int k = 0; k < columns->components; k++)
                own->place[own->count++] = column_own(columns) + k;
        }
}

ComputeOwn compute_own_of(const Constants *s)
{
    ComputeOwn own = {0};
    add_kept(s, s->method->columns, NULL, &own);
    if (s->wide)
        add_kept(s, columns_left, NULL, &own);
    for (const Term *const *term = shared_terms; *term; term++)
        add_kept(s, (*term)->columns, *term, &own);
    return own;
}

static bool widen(Compute *c, unsigned *buffer, int before, int count)
{
    const unsigned wider = compute_buffer(c, "columns of the method's own", 4 * (size_t)count * c->capacity);
    if (!wider)
        return c->full = false;
    if (*buffer && before > 0)
        glCopyNamedBufferSubData(*buffer, wider, 0, 0, (GLsizeiptr)(4 * (size_t)before * c->capacity));
    glDeleteBuffers(1, buffer);
    *buffer = wider;
    return true;
}

/* Requires that terms added later are last in their list. */
bool compute_own_fit(Compute *c)
{
    const ComputeOwn own = compute_own_of(c->constants);
    const int before = c->own.count;
    if (own.count <= before)
        return true;
    if (!widen(c, &c->now.own, before, own.count) || !widen(c, &c->spare.own, before, own.count) ||
        (c->marked.position && !widen(c, &c->marked.own, before, own.count)))
        return false;
    c->own = own;
    return true;
}

void compute_own_rows(const Compute *c, ColumnRows *rows)
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

static void clear_one(const Compute *c, int k, size_t first, size_t count)
{
    if (count > 0)
        glClearNamedBufferSubData(c->now.own, GL_R32F, place_of(c, k, first), (GLsizeiptr)(4 * count), GL_RED,
                                  GL_FLOAT, NULL);
}

/* A column is either written or cleared: NVIDIA's driver (580) let a clear overtake a later write. */
void compute_own_upload(const Compute *c, const ParticleColumns *from)
{
    for (int k = 0; k < c->own.count; k++)
        if (from->own[c->own.place[k]])
            glNamedBufferSubData(c->now.own, place_of(c, k, 0), (GLsizeiptr)(4 * c->count),
                                 from->own[c->own.place[k]]);
        else
            clear_one(c, k, 0, c->count);
}

void compute_own_download(const Compute *c, const ParticleColumns *to)
{
    for (int k = 0; k < c->own.count; k++)
        if (to->own[c->own.place[k]])
            glGetNamedBufferSubData(c->now.own, place_of(c, k, 0), (GLsizeiptr)(4 * c->count),
                                    to->own[c->own.place[k]]);
}

void compute_own_copy(const Compute *c, unsigned from, unsigned to)
{
    for (int k = 0; k < c->own.count; k++)
        glCopyNamedBufferSubData(from, to, place_of(c, k, 0), place_of(c, k, 0), (GLsizeiptr)(4 * c->count));
}

void compute_own_copy_one(const Compute *c, int k, unsigned to)
{
    if (c->count > 0)
        glCopyNamedBufferSubData(c->now.own, to, place_of(c, k, 0), 0, (GLsizeiptr)(4 * c->count));
}

void compute_own_clear(const Compute *c, size_t first, size_t count)
{
    for (int k = 0; k < c->own.count; k++)
        clear_one(c, k, first, count);
}

void compute_own_move(const Compute *c, unsigned order)
{
    if (c->own.count == 0)
        return;
    BIND([ORDERS_BUFFER] = order, [OLD_OWN_BUFFER] = c->now.own, [OWN_BUFFER] = c->spare.own);
    compute_run(c, COMPUTE_OWN_MOVE, c->count);
}

void compute_own_gather(const Compute *c, unsigned marks)
{
    if (c->own.count == 0)
        return;
    BIND([MARKS_BUFFER] = marks, [OLD_OWN_BUFFER] = c->now.own, [OWN_BUFFER] = c->spare.own);
    compute_run(c, COMPUTE_OWN_GATHER, c->count);
}
