/* Between the buffers and plain arrays: for initial states, snapshots and reports, never within a frame. */
#include "sim/gl/compute/compute.h"
#include "sim/sums.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What the buffers hold, on this side. */
typedef struct Copy {
    float *position, *velocity, *pressure; /* 4, 4, 2 a particle */
    uint32_t *name;                        /* 2 */
} Copy;

static void copy_free(Copy *copy)
{
    free(copy->position);
    free(copy->velocity);
    free(copy->pressure);
    free(copy->name);
}

static bool copy_make(Copy *copy, size_t count)
{
    *copy = (Copy){malloc((count + 1) * 16), malloc((count + 1) * 16), malloc((count + 1) * 8),
                   malloc((count + 1) * 8)};
    if (copy->position && copy->velocity && copy->pressure && copy->name)
        return true;
    copy_free(copy);
    return false;
}

static void download(const Compute *c, Copy *copy)
{
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(c->now.position, 0, (GLsizeiptr)(16 * c->count), copy->position);
    glGetNamedBufferSubData(c->now.velocity, 0, (GLsizeiptr)(16 * c->count), copy->velocity);
    glGetNamedBufferSubData(c->now.name, 0, (GLsizeiptr)(8 * c->count), copy->name);
    glGetNamedBufferSubData(c->pressure, 0, (GLsizeiptr)(8 * c->count), copy->pressure);
}

static void upload(const Compute *c, const Copy *copy)
{
    glNamedBufferSubData(c->now.position, 0, (GLsizeiptr)(16 * c->count), copy->position);
    glNamedBufferSubData(c->now.velocity, 0, (GLsizeiptr)(16 * c->count), copy->velocity);
    glNamedBufferSubData(c->now.name, 0, (GLsizeiptr)(8 * c->count), copy->name);
}

bool compute_set_particles(Compute *c, const InitialState *initial)
{
    Copy copy;
    if (!copy_make(&copy, c->count))
        return false;
    for (size_t i = 0; i < c->count; i++) {
        for (size_t k = 0; k < 3; k++) {
            copy.position[4 * i + k] = initial->position[3 * i + k];
            copy.velocity[4 * i + k] = initial->velocity ? initial->velocity[3 * i + k] : 0;
        }
        const uint8_t fluid = initial->fluid ? initial->fluid[i] : 0;
        copy.position[4 * i + 3] = copy.velocity[4 * i + 3] = 0;
        if (c->solver->continuity && initial->density)
            copy.velocity[4 * i + 3] = (float)(initial->density[i] / (double)c->solver->density[fluid] - 1);
        copy.name[2 * i] = (uint32_t)i;
        copy.name[2 * i + 1] = fluid;
    }
    upload(c, &copy);
    copy_free(&copy);
    return true;
}

void compute_save(void *state, const ParticleColumns *to)
{
    const Compute *c = state;
    Copy copy;
    if (!copy_make(&copy, c->count))
        return;
    download(c, &copy);
    for (size_t i = 0; i < c->count; i++) {
        const float *x = copy.position + 4 * i, *v = copy.velocity + 4 * i;
        to->x[i] = x[0], to->y[i] = x[1], to->z[i] = x[2];
        to->vx[i] = v[0], to->vy[i] = v[1], to->vz[i] = v[2];
        if (c->solver->continuity && to->compression)
            to->compression[i] = v[3];
        to->id[i] = copy.name[2 * i];
        to->fluid[i] = (uint8_t)copy.name[2 * i + 1];
    }
    copy_free(&copy);
}

void compute_load(void *state, const ParticleColumns *from, size_t count, size_t guarded)
{
    Compute *c = state;
    Copy copy;
    if (count > c->capacity || !copy_make(&copy, count))
        return;
    compute_set_count(c, count);
    for (size_t i = 0; i < count; i++) {
        float *x = copy.position + 4 * i, *v = copy.velocity + 4 * i;
        x[0] = from->x[i], x[1] = from->y[i], x[2] = from->z[i], x[3] = 0;
        v[0] = from->vx[i], v[1] = from->vy[i], v[2] = from->vz[i];
        v[3] = c->solver->continuity && from->compression ? from->compression[i] : 0;
        copy.name[2 * i] = from->id[i];
        copy.name[2 * i + 1] = from->fluid[i];
    }
    upload(c, &copy);
    copy_free(&copy);
    compute_watch_reset(c, guarded);
}

/* rho / rho0 - 1: carried, or calibrated so that p = c^2 (rho - rho0) holds. */
static float compression_of(const Compute *c, const Copy *copy, size_t i)
{
    const Solver *s = c->solver;
    if (s->continuity)
        return copy->velocity[4 * i + 3];
    return s->compression * (1 / (copy->position[4 * i + 3] * s->rest_number_density) - 1);
}

static float scalar_of(const Compute *c, const Copy *copy, Scalar scalar, size_t i)
{
    const Solver *s = c->solver;
    const float *v = copy->velocity + 4 * i;
    const uint32_t fluid = copy->name[2 * i + 1];
    const float compression = compression_of(c, copy, i);
    switch (scalar) {
    case SCALAR_SPEED:
        return sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    case SCALAR_DENSITY:
        return s->density[fluid] * (1 + compression);
    case SCALAR_COMPRESSION:
        return compression;
    case SCALAR_PRESSURE:
        return copy->pressure[2 * i];
    case SCALAR_FLUID:
        return (float)fluid;
    case SCALAR_ID:
        return (float)copy->name[2 * i];
    case SCALAR_COUNT:
        break;
    }
    return 0;
}

void compute_read(void *state, const ParticleArrays *out)
{
    const Compute *c = state;
    Copy copy;
    if (!copy_make(&copy, c->count))
        return;
    download(c, &copy);
    if (out->position)
        memcpy(out->position, copy.position, 16 * c->count);
    if (out->velocity)
        memcpy(out->velocity, copy.velocity, 16 * c->count);
    for (size_t i = 0; out->velocity && c->solver->continuity && i < c->count; i++)
        out->velocity[4 * i + 3] = 0;
    for (size_t i = 0; out->id && i < c->count; i++)
        out->id[i] = copy.name[2 * i];
    for (size_t i = 0; out->fluid && i < c->count; i++)
        out->fluid[i] = copy.name[2 * i + 1];
    for (int s = 0; s < SCALAR_COUNT; s++)
        for (size_t i = 0; out->scalar[s] && i < c->count; i++)
            out->scalar[s][i] = scalar_of(c, &copy, (Scalar)s, i);
    copy_free(&copy);
}

/* Others with r < h, of those that the last grid shows next to `cell`, where it had particle i. */
static size_t neighbours_of(const Solver *s, const Copy *copy, const uint32_t *start, size_t cell, size_t i)
{
    const float *x = copy->position + 4 * i, h2 = s->support_radius * s->support_radius;
    size_t count = 0;
    for (int row = s->first_row; row < s->last_row; row++) {
        const long middle =
            (long)cell + ((long)(row / 3 - 1) * s->cells.size[1] + (row % 3 - 1)) * s->cells.size[0];
        for (size_t j = start[middle - 1]; j < start[middle + 2]; j++) {
            const float *y = copy->position + 4 * j, dx = x[0] - y[0], dy = x[1] - y[1], dz = x[2] - y[2];
            count += j != i && dx * dx + dy * dy + dz * dz < h2;
        }
    }
    return count;
}

/* Particles are in the order of their cells at the last `grid`: its starts tell these, wherever they are by
 * now. */
static double neighbours_mean(const Compute *c, const Copy *copy)
{
    const size_t cells = c->solver->cells.count;
    uint32_t *start = malloc((cells + 1) * sizeof *start);
    size_t sum = 0;
    if (!start)
        return 0;
    glGetNamedBufferSubData(c->start, 0, (GLsizeiptr)((cells + 1) * sizeof *start), start);
    for (size_t cell = 0; cell < cells; cell++)
        for (size_t i = start[cell]; i < start[cell + 1]; i++)
            sum += neighbours_of(c->solver, copy, start, cell, i);
    free(start);
    return c->count > 0 ? (double)sum / (double)c->count : 0;
}

void compute_sums(void *state, WorldSums *sums)
{
    const Compute *c = state;
    Copy copy;
    *sums = (WorldSums){0};
    if (!copy_make(&copy, c->count))
        return;
    download(c, &copy);
    for (size_t i = 0; i < c->count; i++) {
        const float *xf = copy.position + 4 * i, *vf = copy.velocity + 4 * i;
        const double x[3] = {xf[0], xf[1], xf[2]}, v[3] = {vf[0], vf[1], vf[2]};
        sums_add(sums, c->solver->mass[copy.name[2 * i + 1]], x, v);
    }
    for (int k = 0; k < 3 && c->count > 0; k++)
        sums->centre[k] /= sums->mass;
    sums->neighbours_mean = neighbours_mean(c, &copy);
    copy_free(&copy);
}

void compute_info(const void *state, WorldInfo *info)
{
    const Compute *c = state;
    info->threads = 0;
    info->state_bytes = c->bytes;
    info->guarded = c->guarded_before + c->guarded;
}
