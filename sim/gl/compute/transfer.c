/* Between the buffers and the plain arrays of sim/gl/transfer.h. */
#include "sim/gl/transfer.h"
#include "sim/gl/compute/compute.h"
#include "sim/world/cell_rows.h"

#include <epoxy/gl.h>
#include <stdlib.h>

static void download(const Compute *c, const Transfer *copy)
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(c->now.position, 0, (GLsizeiptr)(16 * c->count), copy->position);
    glGetNamedBufferSubData(c->now.velocity, 0, (GLsizeiptr)(16 * c->count), copy->velocity);
    glGetNamedBufferSubData(c->now.name, 0, (GLsizeiptr)(8 * c->count), copy->name);
    glGetNamedBufferSubData(c->pressure, 0, (GLsizeiptr)(8 * c->count), copy->pressure);
}

static void upload(const Compute *c, const Transfer *copy)
{
    glNamedBufferSubData(c->now.position, 0, (GLsizeiptr)(16 * c->count), copy->position);
    glNamedBufferSubData(c->now.velocity, 0, (GLsizeiptr)(16 * c->count), copy->velocity);
    glNamedBufferSubData(c->now.name, 0, (GLsizeiptr)(8 * c->count), copy->name);
}

bool compute_set_particles(Compute *c, const InitialState *initial)
{
    Transfer copy;
    if (!transfer_make(&copy, c->count))
        return false;
    transfer_set_initial(&copy, c->constants, initial);
    upload(c, &copy);
    transfer_free(&copy);
    return true;
}

bool compute_save(void *state, const ParticleColumns *to)
{
    const Compute *c = state;
    Transfer copy;
    if (!transfer_make(&copy, c->count))
        return false;
    download(c, &copy);
    transfer_get_columns(&copy, c->constants, to);
    transfer_free(&copy);
    return true;
}

bool compute_load(void *state, const ParticleColumns *from, size_t count, size_t guarded)
{
    Compute *c = state;
    Transfer copy;
    if (count > c->capacity || !transfer_make(&copy, count))
        return false;
    compute_set_count(c, count);
    transfer_set_columns(&copy, c->constants, from);
    upload(c, &copy);
    transfer_free(&copy);
    compute_watch_reset(c, guarded);
    return true;
}

bool compute_read(void *state, const ParticleArrays *out)
{
    const Compute *c = state;
    Transfer copy;
    if (!transfer_make(&copy, c->count))
        return false;
    download(c, &copy);
    transfer_get_arrays(&copy, c->constants, out);
    transfer_free(&copy);
    return true;
}

/* Others with r < h, of those that the last grid shows next to `cell`, where it had particle i. */
static size_t neighbours_of(const Constants *s, const Transfer *copy, const uint32_t *start, size_t cell,
                            size_t i)
{
    const float *x = copy->position + 4 * i, h2 = s->support_radius * s->support_radius;
    size_t count = 0;
    CellRow rows[CELL_ROWS];
    const int row_count = cell_rows(s, start, (uint32_t)cell, rows);
    for (int row = 0; row < row_count; row++) {
        if (cell_row_again(s, &rows[row]))
            continue;
        for (size_t j = rows[row].begin; j < rows[row].end; j++) {
            const float *y = copy->position + 4 * j;
            float d[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
            periodic_nearest(&s->periodic, d); /* who has gone through a side since */
            count += j != i && d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < h2;
        }
    }
    return count;
}

/* Particles are in the order of their cells at the last `grid`: its starts tell these, wherever they are by
 * now. */
static double neighbours_mean(const Compute *c, const Transfer *copy)
{
    const size_t cells = c->constants->cells.count;
    uint32_t *start = malloc((cells + 1) * sizeof *start);
    size_t sum = 0;
    if (!start)
        return 0;
    glGetNamedBufferSubData(c->start, 0, (GLsizeiptr)((cells + 1) * sizeof *start), start);
    for (size_t cell = 0; cell < cells; cell++)
        for (size_t i = start[cell]; i < start[cell + 1]; i++)
            sum += neighbours_of(c->constants, copy, start, cell, i);
    free(start);
    return c->count > 0 ? (double)sum / (double)c->count : 0;
}

void compute_sums(void *state, WorldSums *sums)
{
    const Compute *c = state;
    Transfer copy;
    *sums = (WorldSums){0};
    if (!transfer_make(&copy, c->count))
        return;
    download(c, &copy);
    transfer_get_sums(&copy, c->constants, sums);
    sums->neighbours_mean = neighbours_mean(c, &copy);
    transfer_free(&copy);
}

void compute_info(const void *state, WorldInfo *info)
{
    const Compute *c = state;
    info->threads = 0;
    info->state_bytes = c->bytes;
    info->guarded = c->guarded_before + c->guarded;
}
