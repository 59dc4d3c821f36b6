#include "sim/mesh/mesh_shape.h"
#include "sim/solids/solid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Destination of one solid's particles. */
typedef struct PointWriter {
    const SolidDef *solid;
    int dimensions;
    double spacing, depth;
    float *position; /* NULL: only counts */
    size_t count;
} PointWriter;

static void put(PointWriter *sink, double x, double y, double z)
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
static void put_sphere(PointWriter *sink, double radius, double top, long count)
{
    const double golden = M_PI * (3 - sqrt(5));
    for (long i = 0; i < count; i++) {
        const double y = -1 + (1 + top) * ((double)i + 0.5) / (double)count, across = sqrt(1 - y * y);
        const double angle = golden * (double)i;
        put(sink, radius * across * cos(angle), radius * y, radius * across * sin(angle));
    }
}

static double cube(double x)
{
    return x * x * x;
}

/* Mean distance of the matter between two radii from the middle. Particles at half the thickness would be too
   deep behind a curved surface: a ball of three spacings would displace 0.93 of its volume. */
static double mean_radius(int dimensions, double inner, double outer)
{
    const double inner2 = inner * inner, outer2 = outer * outer;
    return dimensions == 2 ? 2.0 / 3 * (cube(outer) - cube(inner)) / (outer2 - inner2)
                           : 0.75 * (outer2 * outer2 - inner2 * inner2) / (cube(outer) - cube(inner));
}

/* `count` points on the ring of the matter between two radii, about z (axis 2) or y (axis 1), at the height
   `along`. */
static void put_ring(PointWriter *sink, int axis, double inner, double outer, long count, double along,
                     double begin, double sweep)
{
    const double radius = count > 1 ? mean_radius(2, inner, outer) : inner;
    for (long i = 0; i < count; i++) {
        const double angle = begin + sweep * ((double)i + 0.5) / (double)count;
        const double a = radius * cos(angle), b = radius * sin(angle);
        if (axis == 1)
            put(sink, a, along, b);
        else
            put(sink, a, b, along);
    }
}

/* Number of particles of the matter from `before` to `after`, in particles' volumes: in all they have the
   volume of the solid. */
static long between(double before, double after)
{
    return lround(after) - lround(before);
}

/* Shells of a ball, or rings of a disc, from the surface inwards. */
static void put_ball(PointWriter *sink)
{
    const double s = sink->spacing, radius = sink->solid->radius / s;
    for (double outer = radius, before = 0, after; outer > 0 && (radius - outer) * s < sink->depth; outer--) {
        const double inner = fmax(outer - 1, 0);
        const bool flat = sink->dimensions == 2;
        after = flat ? M_PI * (radius * radius - inner * inner) : 4 * M_PI / 3 * (cube(radius) - cube(inner));
        const long count = before > 0 ? between(before, after) : at_least_one(after);
        if (flat)
            put_ring(sink, 2, s * inner, s * outer, count, 0, 0, 2 * M_PI);
        else
            put_sphere(sink, s * mean_radius(3, inner, outer), 1, count);
        before = after;
    }
}

/* Shells of the wall of a bowl, or half rings. */
static void put_bowl(PointWriter *sink)
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
            put_ring(sink, 2, inner, outer,
                     at_least_one(M_PI / 2 * (outer * outer - inner * inner) / (s * s)), 0, M_PI, M_PI);
        else
            put_sphere(sink, mean_radius(3, inner, outer), 0,
                       at_least_one(2 * M_PI / 3 * (cube(outer) - cube(inner)) / cube(s)));
    }
}

/* Rows of particles along the block's longest edge. Where the edges are no whole numbers of spacings the rows
   are a little nearer or further apart, and have so many particles that all have the block's volume. */
typedef struct BlockRows {
    int along, across[2];
    long rows[2], layers[2]; /* of rows along each other axis; number on each side that are within the depth,
                                0 in two dimensions for z */
    double step[2], length;  /* between rows; of a row */
    double count;            /* mean number of particles in a row */
} BlockRows;

static BlockRows block_rows(const PointWriter *sink)
{
    const double *size = sink->solid->size, s = sink->spacing;
    BlockRows block = {.rows = {1, 1}, .count = 1};
    for (int k = 1; k < sink->dimensions; k++)
        block.along = size[k] > size[block.along] ? k : block.along;
    for (int a = 0; a < 2; a++) {
        const int k = block.across[a] = (block.along + 1 + a) % 3;
        if (k >= sink->dimensions)
            continue;
        block.rows[a] = at_least_one(size[k] / s);
        block.step[a] = size[k] / (double)block.rows[a];
        block.layers[a] = (long)ceil(sink->depth / block.step[a]);
        block.count *= fmax(size[k] / s, 1) / (double)block.rows[a];
    }
    block.length = size[block.along];
    block.count *= fmax(block.length / s, 1);
    return block;
}

static double block_at(long points, double step, long index)
{
    return ((double)index - 0.5 * (double)(points - 1)) * step;
}

/* Row number `row`: the whole row, or only the two ends. */
static void put_row(PointWriter *sink, const BlockRows *block, long row, const double at[2], bool whole)
{
    const long points =
        at_least_one(floor(block->count * (double)(row + 1) + 0.5) - floor(block->count * (double)row + 0.5));
    const double step = block->length / (double)points;
    const long skip = whole ? points : (long)ceil(sink->depth / step);
    for (long i = 0; i < points; i++) {
        double x[3] = {0};
        if (i == skip && points - skip > i)
            i = points - skip;
        x[block->along] = block_at(points, step, i);
        x[block->across[0]] = at[0], x[block->across[1]] = at[1];
        put(sink, x[0], x[1], x[2]);
    }
}

static bool near_side(const BlockRows *block, int a, long index)
{
    return index < block->layers[a] || index >= block->rows[a] - block->layers[a];
}

static void put_block(PointWriter *sink)
{
    const BlockRows block = block_rows(sink);
    for (long j = 0, row = 0; j < block.rows[1]; j++)
        for (long i = 0; i < block.rows[0]; i++, row++)
            put_row(sink, &block, row,
                    (double[]){block_at(block.rows[0], block.step[0], i),
                               block_at(block.rows[1], block.step[1], j)},
                    near_side(&block, 0, i) || near_side(&block, 1, j));
}

/* Discs of rings; the middle discs have only the outer rings. */
static void put_cylinder(PointWriter *sink)
{
    const double s = sink->spacing, radius = sink->solid->radius / s, height = sink->solid->height;
    const long discs = at_least_one(height / s);
    const double step = height / (double)discs, thick = discs > 1 ? step / s : 1;
    for (long d = 0; d < discs; d++) {
        const double along = ((double)d - 0.5 * (double)(discs - 1)) * step;
        const bool whole = fmin((double)d, (double)(discs - 1 - d)) * step < sink->depth;
        double before = (double)d * thick * M_PI * radius * radius;
        for (double outer = radius; outer > 0 && (whole || (radius - outer) * s < sink->depth); outer--) {
            const double inner = fmax(outer - 1, 0),
                         after = before + thick * M_PI * (outer * outer - inner * inner);
            const long count = between(before, after);
            put_ring(sink, 1, s * inner, s * outer, radius < 1 ? at_least_one((double)count) : count, along,
                     0.7 * (double)d, 2 * M_PI);
            before = after;
        }
    }
}

size_t boundary_layers(const SolidDef *solid, int dimensions, double spacing, double depth, float *position)
{
    PointWriter sink = {solid, dimensions, spacing, depth, position, 0};
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
