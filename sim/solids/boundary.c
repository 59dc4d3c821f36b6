#include "sim/mesh/mesh_shape.h"
#include "sim/solids/boundary_mesh.h"
#include "sim/solids/solid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Destination of one solid's particles. */
typedef struct Sink {
    const SolidDef *solid;
    int dimensions;
    double spacing, depth;
    float *position; /* NULL: only counts */
    size_t count;
} Sink;

static void put(Sink *sink, double x, double y, double z)
{
    if (sink->position) {
        float *to = sink->position + 3 * sink->count;
        to[0] = (float)x, to[1] = (float)y, to[2] = (float)z;
    }
    sink->count++;
}

static long at_least_one(double count)
{
    return count > 1 ? lround(count) : 1;
}

/* `count` points, evenly over the part -1 <= y / radius <= `top` of a sphere: a Fibonacci lattice, whose
   points all have the same area. */
static void put_sphere(Sink *sink, double radius, double top, long count)
{
    const double golden = M_PI * (3 - sqrt(5));
    for (long i = 0; i < count; i++) {
        const double y = -1 + (1 + top) * ((double)i + 0.5) / (double)count, across = sqrt(1 - y * y);
        const double angle = golden * (double)i;
        put(sink, radius * across * cos(angle), radius * y, radius * across * sin(angle));
    }
}

/* A ring about z (axis 2) or y (axis 1) at the height `along`. */
static void put_ring(Sink *sink, int axis, double radius, double along, double begin, double sweep)
{
    const long count = at_least_one(radius * sweep / sink->spacing);
    for (long i = 0; i < count; i++) {
        const double angle = begin + sweep * ((double)i + 0.5) / (double)count;
        const double a = radius * cos(angle), b = radius * sin(angle);
        if (axis == 1)
            put(sink, a, along, b);
        else
            put(sink, a, b, along);
    }
}

static double cube(double x)
{
    return x * x * x;
}

/* Shells of a ball, or rings of a disc, from the surface inwards. */
static void put_ball(Sink *sink)
{
    const double s = sink->spacing;
    for (double outer = sink->solid->radius, behind = 0; outer > 0 && behind < sink->depth;
         outer -= s, behind += s) {
        const double inner = fmax(outer - s, 0), middle = inner > 0 ? 0.5 * (inner + outer) : 0.5 * outer;
        if (sink->dimensions == 2)
            put_ring(sink, 2, middle, 0, 0, 2 * M_PI);
        else
            put_sphere(sink, middle, 1, at_least_one(4 * M_PI / 3 * (cube(outer) - cube(inner)) / cube(s)));
    }
}

/* Shells of the wall of a bowl, or half rings. */
static void put_bowl(Sink *sink)
{
    const SolidDef *solid = sink->solid;
    const double s = sink->spacing;
    const long shells = at_least_one(solid->thickness / s);
    const double step = solid->thickness / (double)shells;
    for (long k = 0; k < shells; k++) {
        const double inner = solid->radius + (double)k * step, outer = inner + step;
        const double behind = fmin((double)k, (double)(shells - 1 - k)) * step;
        if (behind >= sink->depth)
            continue;
        if (sink->dimensions == 2)
            put_ring(sink, 2, 0.5 * (inner + outer), 0, M_PI, M_PI);
        else
            put_sphere(sink, 0.5 * (inner + outer), 0,
                       at_least_one(2 * M_PI / 3 * (cube(outer) - cube(inner)) / cube(s)));
    }
}

/* A lattice that fits the block. */
typedef struct Block {
    long points[3];
    double step[3];
    long layers[3]; /* number of layers on each side that are within the depth */
} Block;

static bool near_side(const Block *block, int k, long index)
{
    return index < block->layers[k] || index >= block->points[k] - block->layers[k];
}

static double block_at(const Block *block, int k, long index)
{
    return ((double)index - 0.5 * (double)(block->points[k] - 1)) * block->step[k];
}

/* One line along x: the whole line, or only the two ends. */
static void put_line(Sink *sink, const Block *block, long y, long z, bool whole)
{
    const long points = block->points[0], skip = whole ? points : block->layers[0];
    for (long x = 0; x < points; x++) {
        if (x == skip && points - skip > x)
            x = points - skip;
        put(sink, block_at(block, 0, x), block_at(block, 1, y), block_at(block, 2, z));
    }
}

static void put_block(Sink *sink)
{
    Block block = {.points = {1, 1, 1}};
    for (int k = 0; k < sink->dimensions; k++) {
        block.points[k] = at_least_one(sink->solid->size[k] / sink->spacing);
        block.step[k] = sink->solid->size[k] / (double)block.points[k];
        block.layers[k] = (long)ceil(sink->depth / block.step[k]);
    }
    for (long z = 0; z < block.points[2]; z++)
        for (long y = 0; y < block.points[1]; y++)
            put_line(sink, &block, y, z, near_side(&block, 1, y) || near_side(&block, 2, z));
}

/* Discs of rings; the middle discs have only the outer rings. */
static void put_cylinder(Sink *sink)
{
    const double s = sink->spacing, radius = sink->solid->radius, height = sink->solid->height;
    const long discs = at_least_one(height / s);
    for (long d = 0; d < discs; d++) {
        const double step = height / (double)discs, along = ((double)d - 0.5 * (double)(discs - 1)) * step;
        const double end = fmin((double)d, (double)(discs - 1 - d)) * step;
        for (double outer = radius, behind = 0; outer > 0 && (behind < sink->depth || end < sink->depth);
             outer -= s, behind += s)
            if (outer > s)
                put_ring(sink, 1, outer - 0.5 * s, along, 0.7 * (double)d, 2 * M_PI);
            else if (outer > 0.25 * s)
                put(sink, 0, along, 0);
    }
}

size_t boundary_layers(const SolidDef *solid, int dimensions, double spacing, double depth, float *position)
{
    Sink sink = {solid, dimensions, spacing, depth, position, 0};
    switch (solid->kind) {
    case SOLID_BOX:
        put_block(&sink);
        break;
    case SOLID_CYLINDER:
        put_cylinder(&sink);
        break;
    case SOLID_BOWL:
        put_bowl(&sink);
        break;
    default:
        put_ball(&sink);
    }
    return sink.count;
}

/* Volume and area of the shape, m3 and m2; in two dimensions m2 and m. */
static void measures(const SolidDef *solid, int dimensions, double *volume, double *area)
{
    const double r = solid->radius, outer = r + solid->thickness, *e = solid->size;
    const bool flat = dimensions == 2;
    switch (solid->kind) {
    case SOLID_BOX:
        *volume = e[0] * e[1] * (flat ? 1 : e[2]);
        *area = flat ? 2 * (e[0] + e[1]) : 2 * (e[0] * e[1] + e[1] * e[2] + e[2] * e[0]);
        break;
    case SOLID_CYLINDER:
        *volume = M_PI * r * r * solid->height;
        *area = 2 * M_PI * r * (r + solid->height);
        break;
    case SOLID_BOWL:
        *volume = flat ? M_PI / 2 * (outer * outer - r * r) : 2 * M_PI / 3 * (cube(outer) - cube(r));
        *area = flat ? M_PI * (outer + r) : 2 * M_PI * (outer * outer + r * r);
        break;
    case SOLID_MESH:
        *volume = cube(solid->mesh.scale) * solid->mesh.shape->volume;
        *area = solid->mesh.scale * solid->mesh.scale * solid->mesh.shape->area;
        break;
    default:
        *volume = flat ? M_PI * r * r : 4 * M_PI / 3 * cube(r);
        *area = flat ? 2 * M_PI * r : 4 * M_PI * r * r;
    }
}

double boundary_estimate(const SolidDef *solid, int dimensions, double spacing, double depth)
{
    double volume, area;
    measures(solid, dimensions, &volume, &area);
    return fmin(volume, area * (depth + spacing)) / pow(spacing, dimensions);
}

/* Move particles inside the box to the front of x; returns their number. A moving solid keeps all
   particles. */
static size_t keep_in_box(const SolidDef *solid, const WorldDef *def, float *x, size_t count)
{
    const int axes = def->dimensions == 2 ? 2 : 3;
    BoxState pose;
    size_t kept = 0;
    if (solid_moves(solid))
        return count;
    solid_pose(solid, 0, &pose);
    for (size_t i = 0; i < count; i++) {
        double at[3] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
        bool in = true;
        quat_rotate(pose.orientation, at, at);
        for (int k = 0; k < axes; k++) {
            const double low = k == 1 ? 0 : -0.5 * def->box_size[k], c = at[k] + pose.position[k];
            in &= c >= low && c <= low + def->box_size[k];
        }
        if (in)
            memmove(x + 3 * kept++, x + 3 * i, 3 * sizeof *x);
    }
    return kept;
}

/* The layers of a solid of the def, for the caller to free; NULL if memory is short. */
static float *layers_of(const WorldDef *def, const SolidDef *solid, size_t *count)
{
    const double depth = def->support * def->spacing;
    if (solid->kind == SOLID_MESH)
        return boundary_mesh_layers(&solid->mesh, def->spacing, depth, count);
    *count = boundary_layers(solid, def->dimensions, def->spacing, depth, NULL);
    float *position = malloc((3 * *count + 1) * sizeof *position);
    if (position)
        boundary_layers(solid, def->dimensions, def->spacing, depth, position);
    return position;
}

static bool add_solid(Boundary *boundary, const WorldDef *def, int index)
{
    size_t count;
    float *layers = layers_of(def, &def->solids[index], &count);
    if (!layers)
        return false;
    count = keep_in_box(&def->solids[index], def, layers, count);
    const size_t all = boundary->count + count;
    float *rest = realloc(boundary->rest, (3 * all + 1) * sizeof *rest);
    boundary->rest = rest ? rest : boundary->rest;
    uint8_t *solid = realloc(boundary->solid, all + 1);
    boundary->solid = solid ? solid : boundary->solid;
    if (rest && solid) {
        memcpy(rest + 3 * boundary->count, layers, 3 * count * sizeof *rest);
        memset(solid + boundary->count, index, count);
        boundary->count = all;
    }
    free(layers);
    return rest && solid;
}

bool boundary_create(Boundary *boundary, const WorldDef *def)
{
    memset(boundary, 0, sizeof *boundary);
    for (int i = 0; i < def->solid_count; i++)
        if (!add_solid(boundary, def, i)) {
            boundary_destroy(boundary);
            return false;
        }
    return true;
}

void boundary_destroy(Boundary *boundary)
{
    free(boundary->rest);
    free(boundary->solid);
    memset(boundary, 0, sizeof *boundary);
}
