#include "render/views/pbsr/pbsr_private.h"
#include "sim/base/base.h"
#include "sim/kernel/kernel.h"
#include "sim/mesh.h"

#include <epoxy/gl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846, CELLS_MAX = 134217728.0;

enum { FLAT_LAYERS = 4, PART = 16384 };

static bool grow_array(void **array, size_t *capacity, size_t count, size_t width)
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

static bool reserve_particles(FluidField *fluid, const ParticleBuffers *particles)
{
    const size_t count = particles->count;
    size_t width = larger(particles->position.stride, particles->fluid.stride);
    for (int s = 0; s < SCALAR_COUNT; s++)
        width = larger(width, particles->scalar[s].stride);
    size_t *sizes = fluid->sizes;
    return grow_array((void **)&fluid->raw, &sizes[0], count * width / sizeof(float), sizeof(float)) &&
           grow_array((void **)&fluid->position, &sizes[1], 4 * count, sizeof(float)) &&
           grow_array((void **)&fluid->value, &sizes[2], count, sizeof(float)) &&
           grow_array((void **)&fluid->members, &sizes[3], count, sizeof(uint32_t));
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
        fluid->members[fluid->count++] = (uint32_t)i;
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
        const float *at = fluid->raw + words * fluid->members[i];
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

void fluid_field_set_grid(FluidField *fluid, const FluidFieldJob *job, const double low[3],
                          const double high[3], double margin, double most)
{
    double cell = job->cell;
    while (grid_for(&fluid->grid, low, high, margin, cell, job->flat > 0) > most)
        cell *= 1.1;
    for (int k = 0; k < 3; k++)
        fluid->side[k] = cell;
    fluid->enlarged = cell / job->cell;
}

static void make_grid(FluidField *fluid, const FluidFieldJob *job)
{
    const FieldParticles some = {fluid->count, fluid->position, NULL, job->particles->support_radius};
    double low[3], high[3];
    if (!field_bounds(&some, low, high))
        memset(low, 0, sizeof low), memset(high, 0, sizeof high);
    fluid_field_set_grid(fluid, job, low, high, some.support, CELLS_MAX);
}

/* ---- sums ---- */

static bool reserve_cells(FluidField *fluid, const FluidFieldJob *job)
{
    const size_t cells = volume_grid_cells(&fluid->grid) * (job->flat > 0 ? FLAT_LAYERS : 1);
    bool made = grow_array((void **)&fluid->field, &fluid->cells, cells, sizeof(float));
    for (int m = 0; m < job->means; m++)
        made = made && grow_array((void **)&fluid->mean[m], &fluid->mean_cells[m], cells, sizeof(float));
    return made;
}

typedef struct DivideJob {
    float *sums;
    const float *known, *field;
} DivideJob;

static void divide(void *context, size_t begin, size_t end)
{
    const DivideJob *dividing = context;
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
    if (!whole && !grow_array((void **)&fluid->known, &fluid->known_cells, cells, sizeof(float)))
        return error_set(error, "no memory for the mean of particles without a number");
    if (!whole && m == 0 && !sum_of(fluid, job, false, fluid->field, NULL, error))
        return false;
    if (!sum_of(fluid, job, true,
                !whole   ? fluid->known
                : m == 0 ? fluid->field
                         : NULL,
                fluid->mean[m], error))
        return false;
    DivideJob dividing = {fluid->mean[m], whole ? fluid->field : fluid->known, fluid->field};
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

void fluid_field_deepen(FluidField *fluid, double flat)
{
    fluid->grid.size[2] = FLAT_LAYERS;
    fluid->side[2] = flat / (FLAT_LAYERS - 1);
    fluid->grid.corner[2] = -0.5 * FLAT_LAYERS * fluid->side[2];
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
    fluid_field_deepen(fluid, flat);
}

double fluid_field_peak(double flat, double support)
{
    return flat > 0 ? 4 / (PI * support * support) : kernel_poly6(0, support);
}

/* The grid contains all fluid in the box, and at least one empty value around. Cells are enlarged if the
   grid would have more than 2^27. Returns false if memory is short. */
static bool fluid_field_make(FluidField *fluid, const FluidFieldJob *job, Error *error)
{
    const double h = job->particles->support_radius;
    const double scale = fluid_field_peak(job->flat, h) / kernel_poly6(0, h);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); /* a GPU backend may have written the buffers */
    if (!reserve_particles(fluid, job->particles))
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

/* The position of a value of the grid, or between values: m. */
static void place_of(const FluidField *fluid, const double index[3], double place[3])
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

int fluid_field_mean_of(const FluidField *fluid, Scalar scalar)
{
    for (int m = 0; m < fluid->means; m++)
        if (fluid->scalar[m] == scalar)
            return m;
    return -1;
}

/* The mean of a scalar; NULL if there is none. */
static const float *fluid_field_mean(const FluidField *fluid, Scalar scalar)
{
    const int mean = fluid_field_mean_of(fluid, scalar);
    return mean >= 0 ? fluid->mean[mean] : NULL;
}

/* a zeroed struct is allowed */
static void fluid_field_free(FluidField *fluid)
{
    field_slabs_free(&fluid->slabs);
    free(fluid->position);
    free(fluid->raw);
    free(fluid->value);
    free(fluid->known);
    free(fluid->members);
    free(fluid->field);
    for (int m = 0; m < FLUID_MEANS_MAX; m++)
        free(fluid->mean[m]);
    *fluid = (FluidField){0};
}

/* Less F means no fluid: F is 0.5 at a plane surface. Isosurfaces of scalars and slices end there. */
static const float FLUID_LEAST = 0.5F;

/* Interpolates between the eight values around a position (in cells from the first value), leaving out NaN
   values. */
static float value_at(const FluidField *fluid, const float *values, const double index[3])
{
    const int *size = fluid->grid.size;
    size_t first[3];
    double part[3], sum = 0, known = 0;
    bool all = true;
    for (int k = 0; k < 3; k++) {
        const double at = fmax(0, fmin(index[k], size[k] - 1.0)), low = fmin(floor(at), fmax(size[k] - 2, 0));
        first[k] = (size_t)low;
        part[k] = at - low;
    }
    for (unsigned c = 0; c < 8; c++) {
        double weight = 1;
        size_t at[3];
        for (int k = 0; k < 3; k++) {
            const bool next = c >> k & 1;
            weight *= next ? part[k] : 1 - part[k];
            at[k] = first[k] + (next && first[k] + 1 < (size_t)size[k]);
        }
        const double value = (double)values[at[0] + (size_t)size[0] * (at[1] + (size_t)size[1] * at[2])];
        all = all && !isnan(value);
        known += isnan(value) ? 0 : weight;
        sum += isnan(value) ? 0 : weight * value;
    }
    return (float)(all ? sum : sum / known);
}

/* ---- isosurfaces ---- */

static void set_vertex(const FluidLayersJob *making, const IsoMesh *mesh, size_t v, const float *values,
                       bool ends, LayerPoint *out)
{
    const FluidField *fluid = &making->out->fluid;
    double index[3], place[3];
    isosurface_place(mesh, v, index);
    place_of(fluid, index, place);
    isosurface_slope(mesh, v, values, out->normal);
    for (int k = 0; k < 3; k++) {
        out->at[k] = (float)place[k];
        out->normal[k] /= (float)fluid->side[k];
    }
    out->value = making->color ? isosurface_value(mesh, v, making->color) : 0;
    if (isnan(out->value))
        out->value = value_at(fluid, making->color, index);
    out->inside = ends ? isosurface_value(mesh, v, fluid->field) - FLUID_LEAST : 1;
}

static bool make_isosurface(const FluidLayersJob *making, const float *values, float level, bool ends,
                            LayerPieces *out)
{
    IsoMesh mesh;
    Error error;
    if (!isosurface(making->out->fluid.grid.size, values, level, &mesh, &error))
        return false;
    const bool made = layer_reserve(out, mesh.vertex_count, mesh.triangle_count);
    for (size_t v = 0; made && v < mesh.vertex_count; v++)
        set_vertex(making, &mesh, v, values, ends, &out->point[v]);
    if (made && mesh.triangle_count > 0)
        memcpy(out->triangle, mesh.triangle, mesh.triangle_count * sizeof *mesh.triangle);
    out->point_count = made ? mesh.vertex_count : 0;
    out->triangle_count = made ? mesh.triangle_count : 0;
    isosurface_free(&mesh);
    return made;
}

/* ---- slices ---- */

/* The plane across an axis: a square at the spacing of the field's values. */
static void straight_slice(const FluidField *fluid, int axis, double level, SliceGrid *out)
{
    *out = (SliceGrid){.count = {0}};
    out->corner[axis] = (level - fluid->grid.corner[axis]) / fluid->side[axis] - 0.5;
    if (!(out->corner[axis] >= 0 && out->corner[axis] <= fluid->grid.size[axis] - 1))
        return;
    for (int i = 0; i < 2; i++) {
        out->along[i][(axis + 1 + i) % 3] = 1;
        out->count[i] = fluid->grid.size[(axis + 1 + i) % 3];
    }
}

/* Where the corners of the field's grid are along a direction through a place: least and greatest, m. */
static void extent_along(const FluidField *fluid, const double place[3], const double way[3], double out[2])
{
    out[0] = INFINITY;
    out[1] = -INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        const double index[3] = {(corner & 1) * (fluid->grid.size[0] - 1.0),
                                 (corner >> 1 & 1) * (fluid->grid.size[1] - 1.0),
                                 (corner >> 2) * (fluid->grid.size[2] - 1.0)};
        double at[3], along = 0;
        place_of(fluid, index, at);
        for (int k = 0; k < 3; k++)
            along += way[k] * (at[k] - place[k]);
        out[0] = fmin(out[0], along);
        out[1] = fmax(out[1], along);
    }
}

/* Squares of `side` m in the plane through `place` along two columns of `turn`, as far as the field goes. */
static void turned_slice(const FluidField *fluid, const double turn[3][3], int axis, const double place[3],
                         double side, SliceGrid *out)
{
    *out = (SliceGrid){.count = {0}};
    double first[3] = {place[0], place[1], place[2]};
    for (int i = 0; i < 2; i++) {
        const int column = (axis + 1 + i) % 3;
        const double way[3] = {turn[0][column], turn[1][column], turn[2][column]};
        double extent[2];
        extent_along(fluid, place, way, extent);
        out->count[i] = (int)ceil((extent[1] - extent[0]) / side) + 1;
        for (int k = 0; k < 3; k++) {
            first[k] += extent[0] * way[k];
            out->along[i][k] = side * way[k] / fluid->side[k];
        }
    }
    for (int k = 0; k < 3; k++)
        out->corner[k] = (first[k] - fluid->grid.corner[k]) / fluid->side[k] - 0.5;
}

void fluid_slice_grid(const FluidField *fluid, const double box[3], const PbsrLayer *said, SliceGrid *out)
{
    const int axis = said->of - PBSR_SLICE_X;
    const double *at = said->position;
    double turn[3][3], place[3] = {0, box[1] / 2, 0}, side = INFINITY;
    if (at[0] == 0 && at[1] == 0 && at[2] == 0 && said->angle_deg == 0) {
        straight_slice(fluid, axis, said->level, out);
        return;
    }
    rigid_rotation(said, turn);
    place[axis] = said->level;
    for (int k = 0; k < 3; k++) {
        place[k] += at[k];
        side = fmin(side, fluid->side[k]);
    }
    for (;; side *= 1.25) {
        turned_slice(fluid, turn, axis, place, side, out);
        if ((out->count[0] <= 2 && out->count[1] <= 2) ||
            (double)out->count[0] * out->count[1] <= (double)volume_grid_cells(&fluid->grid))
            break;
    }
}

static LayerPoint slice_point(const FluidLayersJob *making, const double index[3])
{
    const FluidField *fluid = &making->out->fluid;
    double place[3];
    bool there = true;
    for (int k = 0; k < 3; k++)
        there = there && index[k] >= -1e-6 && index[k] <= fluid->grid.size[k] - 1 + 1e-6;
    place_of(fluid, index, place);
    return (LayerPoint){.at = {(float)place[0], (float)place[1], (float)place[2]},
                        .value = making->color ? value_at(fluid, making->color, index) : 0,
                        .inside = there ? value_at(fluid, fluid->field, index) - FLUID_LEAST : -1};
}

static bool make_slice(const FluidLayersJob *making, const PbsrLayer *said, LayerPieces *out)
{
    SliceGrid grid;
    fluid_slice_grid(&making->out->fluid, making->field->particles->box_size, said, &grid);
    const size_t width = (size_t)grid.count[0], height = (size_t)grid.count[1];
    if (!layer_reserve(out, width * height, 2 * width * height))
        return false;
    for (size_t i = 0; i < width * height; i++) {
        const size_t column = i % width, row = i / width;
        double index[3];
        for (int k = 0; k < 3; k++)
            index[k] = grid.corner[k] + (double)column * grid.along[0][k] + (double)row * grid.along[1][k];
        out->point[i] = slice_point(making, index);
        if (column + 1 < width && row + 1 < height) {
            const uint32_t at = (uint32_t)i, up = (uint32_t)width;
            const uint32_t two[2][3] = {{at, at + 1, at + up}, {at + 1, at + up + 1, at + up}};
            memcpy(out->triangle + out->triangle_count, two, sizeof two);
            out->triangle_count += 2;
        }
    }
    out->point_count = width * height;
    return true;
}

/* ---- cells with fluid ---- */

static bool make_volume(const FluidLayersJob *making, LayerPieces *out)
{
    const FluidField *fluid = &making->out->fluid;
    const size_t width = (size_t)fluid->grid.size[0], height = (size_t)fluid->grid.size[1];
    const size_t cells = out->slab ? width * height : volume_grid_cells(&fluid->grid);
    size_t count = 0;
    for (size_t i = 0; i < cells; i++)
        count += fluid->field[i] > 0;
    if (!layer_reserve(out, count, 0))
        return false;
    for (size_t i = 0; i < cells; i++) {
        const size_t row = i / width, slice = row / height;
        const double index[3] = {(double)(i % width), (double)(row % height), (double)slice};
        double place[3];
        if (!(fluid->field[i] > 0))
            continue;
        place_of(fluid, index, place);
        if (out->slab)
            place[2] = 0;
        out->point[out->point_count++] =
            (LayerPoint){.at = {(float)place[0], (float)place[1], (float)place[2]},
                         .value = making->color ? making->color[i] : 0,
                         .inside = fluid->field[i]};
    }
    return true;
}

/* ---- all layers ---- */

void fluid_layer_describe(LayerPieces *pieces, const FluidField *fluid, const FluidFieldJob *job,
                          const PbsrDef *def, const PbsrLayer *said, int number)
{
    pieces->number = (unsigned)number;
    pieces->cells = said->of == PBSR_VOLUME;
    pieces->density = point_density_of_opacity(said->opacity, pieces->cells ? job->particles->spacing : 1);
    pieces->curved = def->curved;
    pieces->support = job->particles->support_radius;
    memcpy(pieces->cell, fluid->side, sizeof pieces->cell);
    pieces->slab = job->flat > 0;
    if (pieces->slab)
        pieces->cell[2] = job->flat;
}

bool fluid_layer_make(const FluidLayersJob *making, int number)
{
    const PbsrLayer *said = &making->said[number];
    const FluidField *fluid = &making->out->fluid;
    LayerPieces *out = &making->out->layers[number];
    fluid_layer_describe(out, fluid, making->field, making->def, said, number);
    if (pbsr_is_rigid(said) || said->of == PBSR_SOLIDS)
        return layer_reserve(out, 0, 0);
    switch (said->of) {
    case PBSR_SURFACE:
        return make_isosurface(making, fluid->field, (float)said->level, false, out);
    case PBSR_VOLUME:
        return make_volume(making, out);
    case PBSR_SLICE_X:
    case PBSR_SLICE_Y:
    case PBSR_SLICE_Z:
        return make_slice(making, said, out);
    default:
        return make_isosurface(making, fluid_field_mean(fluid, (Scalar)(said->of - PBSR_SCALARS)),
                               (float)said->level, true, out);
    }
}

static void make_some(void *context, size_t begin, size_t end)
{
    FluidLayersJob *making = context;
    for (size_t i = begin; i < end; i++)
        making->failed[i] = !fluid_layer_make(making, (int)i);
}

static void want(FluidFieldJob *job, Scalar scalar)
{
    for (int m = 0; m < job->means; m++)
        if (job->scalar[m] == scalar)
            return;
    job->scalar[job->means++] = scalar;
}

void fluid_field_job(FluidFieldJob *job, const PbsrDef *def, const ParticleBuffers *particles, Scalar color,
                     double flat)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    const int count = pbsr_layers(def, said);
    *job = (FluidFieldJob){
        .particles = particles, .cell = def->cell * particles->spacing, .flat = flat, .color = color};
    for (int i = 0; i < count; i++) {
        job->colored |= !pbsr_has_color(&said[i]) && !pbsr_is_of_file(&said[i]) && said[i].of != PBSR_SOLIDS;
        if (said[i].of >= PBSR_SCALARS && !pbsr_is_rigid(&said[i]))
            want(job, (Scalar)(said[i].of - PBSR_SCALARS));
    }
    if (job->colored)
        want(job, color);
}

bool fluid_layers_make(FluidLayers *layers, const PbsrDef *def, const FluidFieldJob *job, Error *error)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    const int count = pbsr_layers_at(def, job->particles->time, said);
    bool made = true;
    layers->count = 0;
    if (!fluid_field_make(&layers->fluid, job, error))
        return false;
    FluidLayersJob making = {.out = layers,
                             .said = said,
                             .def = def,
                             .field = job,
                             .color = job->colored ? fluid_field_mean(&layers->fluid, job->color) : NULL};
    layers->color = making.color;
    parallel_ranges(parallel_processors(), (size_t)count, 1, make_some, &making);
    for (int i = 0; i < count; i++)
        made = made && !making.failed[i];
    layers->count = made ? count : 0;
    return made || error_set(error, "no memory for the layers of %zu particles", job->particles->count);
}

float fluid_layers_value(const FluidLayers *layers, const float *values, const double place[3])
{
    const FluidField *fluid = &layers->fluid;
    double index[3];
    for (int k = 0; k < 3; k++)
        index[k] = (place[k] - fluid->grid.corner[k]) / fluid->side[k] - 0.5;
    return value_at(fluid, values, index);
}

bool fluid_layers_color(const FluidLayers *layers, const double place[3], float *value)
{
    *value = NAN;
    if (!layers->color || !(fluid_layers_value(layers, layers->fluid.field, place) >= FLUID_LEAST))
        return false;
    *value = fluid_layers_value(layers, layers->color, place);
    return true;
}

void fluid_layers_free(FluidLayers *layers)
{
    fluid_field_free(&layers->fluid);
    for (int i = 0; i < PBSR_LAYERS_MAX; i++)
        layer_free(&layers->layers[i]);
    *layers = (FluidLayers){.count = 0};
}
