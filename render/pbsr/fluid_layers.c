#include "render/pbsr/fluid_layers.h"

#include "render/pbsr/opacity.h"
#include "sim/base/parallel.h"
#include "sim/mesh/isosurface.h"

#include <math.h>
#include <string.h>

/* Less F means no fluid: F is 0.5 at a plane surface. Isosurfaces of scalars and slices end there. */
static const float FLUID_LEAST = 0.5F;

/* Inputs of a layer. */
typedef struct Making {
    FluidLayers *out;
    const PbsrLayer *said;
    const float *color; /* the mean that gives colours; NULL: none */
    double spacing, flat, curved, support;
    bool failed[PBSR_LAYERS_MAX];
} Making;

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

static void set_vertex(const Making *making, const IsoMesh *mesh, size_t v, const float *values, bool ends,
                       LayerPoint *out)
{
    const FluidField *fluid = &making->out->fluid;
    double index[3], place[3];
    isosurface_place(mesh, v, index);
    fluid_field_place(fluid, index, place);
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

static bool make_isosurface(const Making *making, const float *values, float level, bool ends, Layer *out)
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

/* A grid of squares in the plane, at the spacing of the field's values. */
static bool make_slice(const Making *making, int axis, double level, Layer *out)
{
    const FluidField *fluid = &making->out->fluid;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const size_t width = (size_t)fluid->grid.size[u], height = (size_t)fluid->grid.size[v];
    double index[3] = {0}, place[3];
    index[axis] = (level - fluid->grid.corner[axis]) / fluid->side[axis] - 0.5;
    if (!layer_reserve(out, width * height, 2 * width * height))
        return false;
    if (!(index[axis] >= 0 && index[axis] <= fluid->grid.size[axis] - 1))
        return true; /* no fluid at this plane */
    for (size_t i = 0; i < width * height; i++) {
        LayerPoint *point = &out->point[i];
        const size_t column = i % width, row = i / width;
        index[u] = (double)column;
        index[v] = (double)row;
        fluid_field_place(fluid, index, place);
        *point = (LayerPoint){.at = {(float)place[0], (float)place[1], (float)place[2]},
                              .value = making->color ? value_at(fluid, making->color, index) : 0,
                              .inside = value_at(fluid, fluid->field, index) - FLUID_LEAST};
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

static bool make_volume(const Making *making, Layer *out)
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
        fluid_field_place(fluid, index, place);
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

static bool make_layer(const Making *making, int number)
{
    const PbsrLayer *said = &making->said[number];
    const FluidField *fluid = &making->out->fluid;
    Layer *out = &making->out->layers[number];
    out->number = (unsigned)number;
    out->density = point_density_of_opacity(said->opacity, said->of == PBSR_VOLUME ? making->spacing : 1);
    out->curved = making->curved;
    out->support = making->support;
    memcpy(out->cell, fluid->side, sizeof out->cell);
    out->slab = making->flat > 0;
    if (out->slab)
        out->cell[2] = making->flat;
    if (pbsr_still(said) || said->of == PBSR_SOLIDS)
        return layer_reserve(out, 0, 0);
    switch (said->of) {
    case PBSR_SURFACE:
        return make_isosurface(making, fluid->field, (float)said->level, false, out);
    case PBSR_VOLUME:
        return make_volume(making, out);
    case PBSR_SLICE_X:
    case PBSR_SLICE_Y:
    case PBSR_SLICE_Z:
        return make_slice(making, said->of - PBSR_SLICE_X, said->level, out);
    default:
        return make_isosurface(making, fluid_field_mean(fluid, (Scalar)(said->of - PBSR_SCALARS)),
                               (float)said->level, true, out);
    }
}

static void make_some(void *context, size_t begin, size_t end)
{
    Making *making = context;
    for (size_t i = begin; i < end; i++)
        making->failed[i] = !make_layer(making, (int)i);
}

static void want(FluidFieldJob *job, Scalar scalar)
{
    for (int m = 0; m < job->means; m++)
        if (job->scalar[m] == scalar)
            return;
    job->scalar[job->means++] = scalar;
}

bool fluid_layers_make(FluidLayers *layers, const PbsrDef *def, const ParticleBuffers *particles,
                       Scalar color, double flat, Error *error)
{
    PbsrLayer said[PBSR_LAYERS_MAX];
    const int count = pbsr_layers(def, said);
    bool colored = false, made = true;
    FluidFieldJob job = {particles, def->cell * particles->spacing, flat, 0, {0}};
    for (int i = 0; i < count; i++) {
        colored =
            colored || (!pbsr_colored(&said[i]) && !pbsr_of_file(&said[i]) && said[i].of != PBSR_SOLIDS);
        if (said[i].of >= PBSR_SCALARS && !pbsr_still(&said[i]))
            want(&job, (Scalar)(said[i].of - PBSR_SCALARS));
    }
    if (colored)
        want(&job, color);
    layers->count = 0;
    if (!fluid_field_make(&layers->fluid, &job, error))
        return false;
    Making making = {.out = layers,
                     .said = said,
                     .color = colored ? fluid_field_mean(&layers->fluid, color) : NULL,
                     .spacing = particles->spacing,
                     .flat = flat,
                     .curved = def->curved,
                     .support = particles->support_radius};
    layers->color = making.color;
    parallel_ranges(parallel_processors(), (size_t)count, 1, make_some, &making);
    for (int i = 0; i < count; i++)
        made = made && !making.failed[i];
    layers->count = made ? count : 0;
    return made || error_set(error, "no memory for the layers of %zu particles", particles->count);
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
