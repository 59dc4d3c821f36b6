#include "render/pbsr/fluid_field.h"

#include "sim/base/parallel.h"
#include "sim/kernel/kernel.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846, CELLS_MAX = 134217728.0;

enum { FLAT_LAYERS = 4, PART = 16384 };

static bool room(void **array, size_t *capacity, size_t count, size_t width)
{
    if (count <= *capacity && *array)
        return true;
    free(*array);
    *capacity = 0;
    *array = malloc((count + count / 4 + 1) * width);
    if (*array)
        *capacity = count + count / 4;
    return *array != NULL;
}

/* ---- particles in the field ---- */

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

static bool reserve(FluidField *fluid, const ParticleBuffers *particles)
{
    const size_t count = particles->count;
    size_t width = larger(particles->position.stride, particles->fluid.stride);
    for (int s = 0; s < SCALAR_COUNT; s++)
        width = larger(width, particles->scalar[s].stride);
    size_t *sizes = fluid->sizes;
    return room((void **)&fluid->raw, &sizes[0], count * width / sizeof(float), sizeof(float)) &&
           room((void **)&fluid->position, &sizes[1], 4 * count, sizeof(float)) &&
           room((void **)&fluid->value, &sizes[2], count, sizeof(float)) &&
           room((void **)&fluid->kept, &sizes[3], count, sizeof(uint32_t));
}

static void read_raw(FluidField *fluid, const ParticleAttribute *from, size_t count)
{
    if (count > 0)
        glGetNamedBufferSubData(from->buffer, (GLintptr)from->offset, (GLsizeiptr)(count * from->stride),
                                fluid->raw);
}

/* True for particles in the box, or within a support radius: fluid that has left the box is ignored. */
static bool counts(const float at[4], const ParticleBuffers *particles)
{
    const double *box = particles->box_size, h = particles->support_radius;
    return at[3] > 0 && at[3] < 1e30F && fabs((double)at[0]) <= box[0] / 2 + h && at[1] >= -h &&
           at[1] <= box[1] + h && fabs((double)at[2]) <= box[2] / 2 + h; /* false for NaN */
}

/* `scale`: factor of volumes, for the kernel of another dimension. */
static void read_positions(FluidField *fluid, const FluidFieldJob *job, float scale)
{
    const ParticleBuffers *particles = job->particles;
    const size_t words = particles->position.stride / sizeof(float);
    read_raw(fluid, &particles->position, particles->count);
    fluid->count = 0;
    for (size_t i = 0; i < particles->count; i++) {
        float at[4];
        memcpy(at, fluid->raw + words * i, sizeof at);
        if (!counts(at, particles))
            continue;
        at[2] = job->flat > 0 ? 0 : at[2];
        at[3] *= scale;
        memcpy(fluid->position + 4 * fluid->count, at, sizeof at);
        fluid->kept[fluid->count++] = (uint32_t)i;
    }
}

/* Returns true if all values are numbers. */
static bool read_values(FluidField *fluid, const ParticleBuffers *particles, Scalar scalar)
{
    const ParticleAttribute *from = scalar == SCALAR_FLUID ? &particles->fluid : &particles->scalar[scalar];
    const size_t words = from->stride / sizeof(float);
    bool all = true;
    if (from->buffer)
        read_raw(fluid, from, particles->count);
    for (size_t i = 0; i < fluid->count; i++) {
        const float *at = fluid->raw + words * fluid->kept[i];
        uint32_t number;
        float value = 0;
        if (from->buffer)
            memcpy(scalar == SCALAR_FLUID ? (void *)&number : (void *)&value, at, sizeof value);
        if (from->buffer && scalar == SCALAR_FLUID)
            value = (float)number;
        fluid->value[i] = fabsf(value) < 1e30F ? value : NAN;
        all = all && fabsf(value) < 1e30F;
    }
    return all;
}

/* ---- the grid ---- */

static double grid_for(VolumeGrid *grid, const double low[3], const double high[3], double margin,
                       double cell, bool flat)
{
    double all = 1;
    grid->cell = cell;
    for (int k = 0; k < 3; k++) {
        const double cells = ceil((high[k] - low[k] + 2 * margin) / cell) + 3;
        grid->corner[k] = (low[k] + high[k] - cells * cell) / 2;
        grid->size[k] = (int)fmin(cells, 1e6);
        all *= cells;
    }
    if (!flat)
        return all;
    grid->size[2] = 1; /* the layer's values are at z = 0 */
    grid->corner[2] = -cell / 2;
    return (double)grid->size[0] * grid->size[1] * FLAT_LAYERS;
}

static void make_grid(FluidField *fluid, const FluidFieldJob *job)
{
    const FieldParticles some = {fluid->count, fluid->position, NULL, job->particles->support_radius};
    double low[3], high[3], cell = job->cell;
    if (!field_bounds(&some, low, high))
        memset(low, 0, sizeof low), memset(high, 0, sizeof high);
    while (grid_for(&fluid->grid, low, high, some.support, cell, job->flat > 0) > CELLS_MAX)
        cell *= 1.1;
    for (int k = 0; k < 3; k++)
        fluid->side[k] = cell;
    fluid->enlarged = cell / job->cell;
}

/* ---- sums ---- */

static bool reserve_cells(FluidField *fluid, const FluidFieldJob *job)
{
    const size_t cells = volume_grid_cells(&fluid->grid) * (job->flat > 0 ? FLAT_LAYERS : 1);
    bool made = room((void **)&fluid->field, &fluid->cells, cells, sizeof(float));
    for (int m = 0; m < job->means; m++)
        made = made && room((void **)&fluid->mean[m], &fluid->mean_cells[m], cells, sizeof(float));
    return made;
}

typedef struct Dividing {
    float *sums;
    const float *known, *field;
} Dividing;

static void divide(void *context, size_t begin, size_t end)
{
    const Dividing *dividing = context;
    for (size_t i = begin; i < end; i++)
        dividing->sums[i] = dividing->known[i] > 0   ? dividing->sums[i] / dividing->known[i]
                            : dividing->field[i] > 0 ? NAN
                                                     : 0;
}

/* Sums F; with `scalar`, F of the particles with a number, and the sum of the scalar. */
static bool sum_of(FluidField *fluid, const FluidFieldJob *job, bool scalar, float *field, float *weighted,
                   Error *error)
{
    const FieldParticles some = {fluid->count, fluid->position, scalar ? fluid->value : NULL,
                                 job->particles->support_radius};
    return field_sum(&some, &fluid->grid, parallel_processors(), &fluid->slabs, field, weighted, error);
}

/* Computes F together with the first mean, if all particles have a number. */
static bool sum_mean(FluidField *fluid, const FluidFieldJob *job, int m, Error *error)
{
    const size_t cells = volume_grid_cells(&fluid->grid);
    const bool whole = read_values(fluid, job->particles, job->scalar[m]);
    if (!whole && !room((void **)&fluid->known, &fluid->known_cells, cells, sizeof(float)))
        return error_set(error, "no memory for the mean of particles without a number");
    if (!whole && m == 0 && !sum_of(fluid, job, false, fluid->field, NULL, error))
        return false;
    if (!sum_of(fluid, job, true,
                !whole   ? fluid->known
                : m == 0 ? fluid->field
                         : NULL,
                fluid->mean[m], error))
        return false;
    Dividing dividing = {fluid->mean[m], whole ? fluid->field : fluid->known, fluid->field};
    parallel_ranges(parallel_processors(), cells, PART, divide, &dividing);
    return true;
}

static bool sum(FluidField *fluid, const FluidFieldJob *job, Error *error)
{
    if (job->means == 0)
        return sum_of(fluid, job, false, fluid->field, NULL, error);
    for (int m = 0; m < job->means; m++)
        if (!sum_mean(fluid, job, m, error))
            return false;
    return true;
}

/* Copies the one layer of values to several, through the depth of the box. */
static void deepen(FluidField *fluid, double flat)
{
    const size_t slice = volume_grid_cells(&fluid->grid);
    for (int layer = 1; layer < FLAT_LAYERS; layer++) {
        memcpy(fluid->field + slice * (size_t)layer, fluid->field, slice * sizeof(float));
        for (int m = 0; m < fluid->means; m++)
            memcpy(fluid->mean[m] + slice * (size_t)layer, fluid->mean[m], slice * sizeof(float));
    }
    fluid->grid.size[2] = FLAT_LAYERS;
    fluid->side[2] = flat / (FLAT_LAYERS - 1);
    fluid->grid.corner[2] = -0.5 * FLAT_LAYERS * fluid->side[2];
}

bool fluid_field_make(FluidField *fluid, const FluidFieldJob *job, Error *error)
{
    const double h = job->particles->support_radius;
    const double scale = job->flat > 0 ? 4 / (PI * h * h) / kernel_poly6(0, h) : 1;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); /* a GPU backend may have written the buffers */
    if (!reserve(fluid, job->particles))
        return error_set(error, "no memory to read %zu particles", job->particles->count);
    read_positions(fluid, job, (float)scale);
    make_grid(fluid, job);
    if (!reserve_cells(fluid, job))
        return error_set(error, "no memory for a grid of %d x %d x %d cells: take a larger view.pbsr.cell",
                         fluid->grid.size[0], fluid->grid.size[1], fluid->grid.size[2]);
    fluid->means = job->means;
    memcpy(fluid->scalar, job->scalar, sizeof fluid->scalar);
    if (!sum(fluid, job, error))
        return false;
    if (job->flat > 0)
        deepen(fluid, job->flat);
    return true;
}

void fluid_field_place(const FluidField *fluid, const double index[3], double place[3])
{
    for (int k = 0; k < 3; k++)
        place[k] = fluid->grid.corner[k] + (index[k] + 0.5) * fluid->side[k];
}

void fluid_field_particles(FluidField *fluid, const ParticleBuffers *particles, Scalar scalar,
                           FieldParticles *out)
{
    read_values(fluid, particles, scalar);
    *out = (FieldParticles){fluid->count, fluid->position, fluid->value, particles->support_radius};
}

const float *fluid_field_mean(const FluidField *fluid, Scalar scalar)
{
    for (int m = 0; m < fluid->means; m++)
        if (fluid->scalar[m] == scalar)
            return fluid->mean[m];
    return NULL;
}

void fluid_field_free(FluidField *fluid)
{
    field_slabs_free(&fluid->slabs);
    free(fluid->position);
    free(fluid->raw);
    free(fluid->value);
    free(fluid->known);
    free(fluid->kept);
    free(fluid->field);
    for (int m = 0; m < FLUID_MEANS_MAX; m++)
        free(fluid->mean[m]);
    *fluid = (FluidField){0};
}
