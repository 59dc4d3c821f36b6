/* Voxelization on the CPU: each thread sums up the slices of a slab of its own, so that none waits and the
   sums' order is that of the particles, whatever the number of threads. */
#include "render/voxelize.h"
#include "render/voxelize_rows.h"

#include <epoxy/gl.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { THREADS_MAX = 32 };

typedef struct Region {
    int low[3], end[3]; /* cells; empty where end <= low */
} Region;

typedef struct Slabs {
    bool scalar;
    float *words; /* read from the GPU: positions, then scalars */
    Ball *balls;
    size_t capacity, count; /* balls there is room for, that count */
    VolumeRows rows;
    Region touched; /* cells that may be other than 0 */
} Slabs;

typedef struct Slab {
    Slabs *slabs;
    Region clear; /* what to clear in this slab */
    int low, end; /* slices */
} Slab;

static void slabs_destroy(void *state)
{
    Slabs *own = state;
    free(own->words);
    free(own->balls);
    free(own->rows.field);
    free(own->rows.scalar);
    free(own);
}

static void *slabs_create(VolumeMethod method, bool scalar, Error *error)
{
    Slabs *own = calloc(1, sizeof *own);
    (void)method;
    if (own)
        own->scalar = scalar;
    else
        error_set(error, "out of memory for the voxelizer");
    return own;
}

static bool reserve_balls(Slabs *own, size_t count)
{
    if (count <= own->capacity)
        return true;
    free(own->words);
    free(own->balls);
    own->words = malloc(count * 5 * sizeof(float));
    own->balls = malloc(count * sizeof *own->balls);
    own->capacity = own->words && own->balls ? count : 0;
    return own->capacity > 0;
}

static float *zeros(size_t count)
{
    return calloc(count, sizeof(float));
}

static bool reserve_rows(Slabs *own, const int size[3])
{
    VolumeRows *rows = &own->rows;
    if (rows->field && memcmp(rows->size, size, sizeof rows->size) == 0)
        return true;
    free(rows->field);
    free(rows->scalar);
    *rows = (VolumeRows){.stride = ((size_t)size[0] + 2 * ROW_LANES - 1) / ROW_LANES * ROW_LANES};
    memcpy(rows->size, size, sizeof rows->size);
    own->touched = (Region){0};
    const size_t count = rows->stride * (size_t)size[1] * (size_t)size[2];
    rows->field = zeros(count);
    rows->scalar = own->scalar ? zeros(count) : NULL;
    return rows->field && (rows->scalar || !own->scalar);
}

/* With strides of one word and of four the driver copies straight. */
static void read_attribute(const ParticleAttribute *from, size_t count, size_t words, float *to, size_t step)
{
    const size_t stride = from->stride / sizeof(float);
    float *raw = stride == step ? to : malloc(count * from->stride);
    if (!raw)
        return;
    glGetNamedBufferSubData(from->buffer, (GLintptr)from->offset, (GLsizeiptr)(count * from->stride), raw);
    for (size_t i = 0; raw != to && i < count; i++)
        memcpy(to + step * i, raw + stride * i, words * sizeof(float));
    if (raw != to)
        free(raw);
}

static bool ball_of(const float at[4], float scalar, const VoxelizeJob *job, Ball *ball)
{
    const VolumeGrid *grid = &job->volume->grid;
    if (!(at[3] > 0 && at[3] < 1e30F))
        return false;
    for (int k = 0; k < 3; k++) {
        if (!((double)at[k] >= job->low[k] && (double)at[k] <= job->high[k])) /* nor NaN */
            return false;
        ball->at[k] = (float)(((double)at[k] - grid->corner[k]) / grid->cell);
    }
    const float amplitude = at[3] * (float)job->amplitude;
    ball->scale = cbrtf(amplitude);
    ball->scalar = fabsf(scalar) < 1e30F ? scalar : 0;
    return true;
}

static void make_balls(Slabs *own, const VoxelizeJob *job)
{
    const ParticleBuffers *particles = job->particles;
    const ParticleAttribute *scalar = &particles->scalar[job->carried];
    const size_t count = particles->count;
    float *scalars = own->words + 4 * count;
    const bool carried = own->scalar && scalar->buffer;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    read_attribute(&particles->position, count, 4, own->words, 4);
    if (carried)
        read_attribute(scalar, count, 1, scalars, 1);
    own->count = 0;
    for (size_t i = 0; i < count; i++)
        own->count += ball_of(own->words + 4 * i, carried ? scalars[i] : 0, job, &own->balls[own->count]);
}

static int clamp(double value, int high)
{
    return (int)fmax(0, fmin(value, high));
}

static Region region_of(const Slabs *own, double radius)
{
    Region region;
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < own->count; i++)
        for (int k = 0; k < 3; k++) {
            low[k] = fminf(low[k], own->balls[i].at[k]);
            high[k] = fmaxf(high[k], own->balls[i].at[k]);
        }
    for (int k = 0; k < 3; k++) {
        region.low[k] = clamp(floor(low[k] - radius), own->rows.size[k]);
        region.end[k] = clamp(ceil(high[k] + radius), own->rows.size[k]);
    }
    return own->count ? region : (Region){0};
}

static bool is_empty(const Region *region)
{
    return region->end[0] <= region->low[0] || region->end[1] <= region->low[1] ||
           region->end[2] <= region->low[2];
}

static Region both(const Region *a, const Region *b)
{
    Region all = *a;
    if (is_empty(a) || is_empty(b))
        return is_empty(a) ? *b : *a;
    for (int k = 0; k < 3; k++) {
        all.low[k] = a->low[k] < b->low[k] ? a->low[k] : b->low[k];
        all.end[k] = a->end[k] > b->end[k] ? a->end[k] : b->end[k];
    }
    return all;
}

/* The first slices of so many slabs of equal work, by the balls that reach each slice. */
static void share_out(const Slabs *own, double radius, int slabs, int first[])
{
    const int size = own->rows.size[2];
    double *work = calloc((size_t)size + 2, sizeof *work), all = 0, done = 0;
    for (size_t i = 0; work && i < own->count; i++) {
        work[clamp(floor(own->balls[i].at[2] - radius), size)] += 1;
        work[clamp(ceil(own->balls[i].at[2] + radius), size)] -= 1;
    }
    for (int slice = 1; work && slice < size; slice++)
        work[slice] += work[slice - 1];
    for (int slice = 0; work && slice < size; slice++)
        all += work[slice] + 1e-3;
    for (int slab = 0, slice = 0; slab <= slabs; slab++) {
        while (work && slice < size && done < all * slab / slabs)
            done += work[slice++] + 1e-3;
        first[slab] = work ? slice : size * slab / slabs;
    }
    first[slabs] = size;
    free(work);
}

static void clear(float *values, const VolumeRows *rows, const Region *region)
{
    const size_t bytes = (size_t)(region->end[0] - region->low[0]) * sizeof *values;
    for (int z = region->low[2]; values && z < region->end[2]; z++)
        for (int y = region->low[1]; y < region->end[1]; y++)
            memset(values + ((size_t)z * (size_t)rows->size[1] + (size_t)y) * rows->stride + region->low[0],
                   0, bytes);
}

static void *run_slab(void *context)
{
    Slab *slab = context;
    Slabs *own = slab->slabs;
    Region *region = &slab->clear;
    if (region->low[2] < slab->low)
        region->low[2] = slab->low;
    if (region->end[2] > slab->end)
        region->end[2] = slab->end;
    if (!is_empty(region)) {
        clear(own->rows.field, &own->rows, region);
        clear(own->rows.scalar, &own->rows, region);
    }
    volume_rows_add(&own->rows, own->balls, own->count, slab->low, slab->end);
    return NULL;
}

static int thread_count(void)
{
    const long there = sysconf(_SC_NPROCESSORS_ONLN);
    return (int)(there < 1 ? 1 : there > THREADS_MAX ? THREADS_MAX : there);
}

static void run_slabs(Slabs *own, double radius)
{
    const int threads = thread_count();
    int first[THREADS_MAX + 1];
    Slab slabs[THREADS_MAX];
    pthread_t thread[THREADS_MAX];
    bool started[THREADS_MAX];
    share_out(own, radius, threads, first);
    for (int i = 0; i < threads; i++)
        slabs[i] = (Slab){own, own->touched, first[i], first[i + 1]};
    for (int i = 1; i < threads; i++)
        started[i] = pthread_create(&thread[i], NULL, run_slab, &slabs[i]) == 0;
    run_slab(&slabs[0]);
    for (int i = 1; i < threads; i++)
        if (started[i])
            pthread_join(thread[i], NULL);
        else
            run_slab(&slabs[i]);
}

static void send(const VolumeRows *rows, const float *values, GLuint texture, const Region *region)
{
    const int *low = region->low, *end = region->end;
    if (texture)
        glTextureSubImage3D(
            texture, 0, low[0], low[1], low[2], end[0] - low[0], end[1] - low[1], end[2] - low[2], GL_RED,
            GL_FLOAT,
            values + ((size_t)low[2] * (size_t)rows->size[1] + (size_t)low[1]) * rows->stride + low[0]);
}

/* What was touched the last time is 0 now, and must be sent too. */
static void send_changes(const Slabs *own, const Volume *volume, const Region *changed)
{
    if (is_empty(changed))
        return;
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, (GLint)own->rows.stride);
    glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, own->rows.size[1]);
    send(&own->rows, own->rows.field, volume->field, changed);
    send(&own->rows, own->rows.scalar, volume->scalar, changed);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glPixelStorei(GL_UNPACK_IMAGE_HEIGHT, 0);
}

static bool slabs_run(void *state, const VoxelizeJob *job, Error *error)
{
    Slabs *own = state;
    if (!reserve_balls(own, job->particles->count + 1) || !reserve_rows(own, job->volume->grid.size))
        return error_set(error, "no memory for the sums of a volume; take larger cells");
    make_balls(own, job);
    own->rows.radius = (float)job->radius;
    const Region now = region_of(own, job->radius), changed = both(&own->touched, &now);
    run_slabs(own, job->radius);
    send_changes(own, job->volume, &changed);
    own->touched = now;
    return true;
}

const VoxelizeMethod voxelize_slabs = {
    .create = slabs_create,
    .destroy = slabs_destroy,
    .run = slabs_run,
};
