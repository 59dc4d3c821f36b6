#include "sim/start/start.h"

#include "sim/def.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 20 };             /* pushes fall to a tenth in so many */
static const double PART = 0.5;   /* per round: way over a spacing's square times the gradient */
static const double MOST = 0.1;   /* greatest way along an axis per round, spacings */
static const double WHOLE = 0.95; /* least fullness of a particle to move */

/* Fluid first, then boundary particles, in cells of a support radius. */
typedef struct PackingJob {
    size_t fluid, count;
    float *position; /* 3 each */
    uint32_t *near;  /* fluid particles allowed to move */
    size_t near_count;
    double *way;     /* 3 per particle of `near`, m */
    uint32_t *begin; /* begin of each cell in `order`, and end of the last */
    uint32_t *order;
    int cells[3];
    double h;
    const WorldDef *def;
    BoxState pose[SOLIDS_MAX]; /* of the solids, at the start */
} PackingJob;

static void to_solid(const BoxState *pose, const float *x, double out[3])
{
    for (int a = 0; a < 3; a++)
        out[a] = (double)x[a] - pose->position[a];
    quat_rotate_inverse(pose->orientation, out, out);
}

/* True if x is nearer than `reach` (m) to one of the first `solids`. */
static bool within(const WorldDef *def, const BoxState *pose, int solids, const float *x, double reach)
{
    double at[3];
    for (int k = 0; k < solids; k++) {
        to_solid(&pose[k], x, at);
        const double far = solid_reach(&def->solids[k]) + fmax(reach, 0);
        if (at[0] * at[0] + at[1] * at[1] + at[2] * at[2] < far * far &&
            solid_distance(&def->solids[k], def->dimensions, at) < reach)
            return true;
    }
    return false;
}

static bool in_box(const WorldDef *def, const float *x)
{
    for (int a = 0; a < def->dimensions; a++) {
        const double at = (double)x[a] + (a == 1 ? 0 : 0.5 * def->box_size[a]);
        if (!(at >= 0 && at <= def->box_size[a]))
            return false;
    }
    return true;
}

/* Boundary particles visible to fluid: not behind walls, nor in a solid named earlier. */
static void add_boundary(PackingJob *crowd, const Boundary *boundary)
{
    const BoxState *pose = crowd->pose;
    for (size_t b = 0; b < boundary->count; b++) {
        const int solid = boundary->solid[b];
        float *x = crowd->position + 3 * crowd->count;
        double at[3] = {(double)boundary->rest[3 * b], (double)boundary->rest[3 * b + 1],
                        (double)boundary->rest[3 * b + 2]};
        quat_rotate(pose[solid].orientation, at, at);
        for (int a = 0; a < 3; a++)
            x[a] = (float)(at[a] + pose[solid].position[a]);
        if (in_box(crowd->def, x) && !within(crowd->def, pose, solid, x, 0))
            crowd->count++;
    }
}

static void cell_of(const PackingJob *crowd, const float *x, int cell[3])
{
    for (int a = 0; a < 3; a++) {
        const double low = a == 1 ? 0 : -0.5 * crowd->def->box_size[a], at = ((double)x[a] - low) / crowd->h;
        cell[a] = at < 0 || crowd->cells[a] == 1        ? 0
                  : at >= (double)(crowd->cells[a] - 1) ? crowd->cells[a] - 1
                                                        : (int)at;
    }
}

static size_t cell_at(const PackingJob *crowd, int x, int y, int z)
{
    return ((size_t)z * (size_t)crowd->cells[1] + (size_t)y) * (size_t)crowd->cells[0] + (size_t)x;
}

static size_t cell_count(const PackingJob *crowd)
{
    return cell_at(crowd, 0, 0, crowd->cells[2]);
}

static void sort(PackingJob *crowd)
{
    const size_t cells = cell_count(crowd);
    int c[3];
    memset(crowd->begin, 0, (cells + 2) * sizeof *crowd->begin);
    for (size_t i = 0; i < crowd->count; i++) {
        cell_of(crowd, crowd->position + 3 * i, c);
        crowd->begin[cell_at(crowd, c[0], c[1], c[2]) + 2]++;
    }
    for (size_t k = 2; k < cells + 2; k++)
        crowd->begin[k] += crowd->begin[k - 1];
    for (size_t i = 0; i < crowd->count; i++) {
        cell_of(crowd, crowd->position + 3 * i, c);
        crowd->order[crowd->begin[cell_at(crowd, c[0], c[1], c[2]) + 1]++] = (uint32_t)i;
    }
}

/* Add the sums over a cell: of V0 F x_ij, 1/m, and in out[3] of V0 F r^2 over the dimensions: how full. */
static void sum_cell(const PackingJob *crowd, const Lattice *lattice, uint32_t i, size_t cell, double out[4])
{
    const float *x = crowd->position + 3 * (size_t)i;
    for (uint32_t at = crowd->begin[cell]; at < crowd->begin[cell + 1]; at++) {
        const float *y = crowd->position + 3 * (size_t)crowd->order[at];
        const double d[3] = {(double)(x[0] - y[0]), (double)(x[1] - y[1]), (double)(x[2] - y[2])};
        const double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        if (crowd->order[at] == i || r2 >= crowd->h * crowd->h || r2 == 0)
            continue;
        const double r = sqrt(r2), f = -lattice->gradient_scale *
                                       lattice->pressure_kernel->derivative(r, crowd->h) /
                                       (r * lattice->number_density);
        for (int a = 0; a < 3; a++)
            out[a] += f * d[a];
        out[3] += f * r2 / lattice->dimensions;
    }
}

static void find_way(const PackingJob *crowd, const Lattice *lattice, uint32_t i, double way[3])
{
    const double spacing = crowd->def->spacing, most = MOST * spacing;
    double sum[4] = {0};
    int c[3];
    cell_of(crowd, crowd->position + 3 * (size_t)i, c);
    for (int z = c[2] - 1; z <= c[2] + 1; z++)
        for (int y = c[1] - 1; y <= c[1] + 1; y++)
            for (int x = c[0] - 1; x <= c[0] + 1; x++)
                if (x >= 0 && x < crowd->cells[0] && y >= 0 && y < crowd->cells[1] && z >= 0 &&
                    z < crowd->cells[2])
                    sum_cell(crowd, lattice, i, cell_at(crowd, x, y, z), sum);
    for (int a = 0; a < 3; a++)
        way[a] = sum[3] < WHOLE ? 0 : fmin(fmax(PART * spacing * spacing * sum[a], -most), most);
}

static bool crowd_create(PackingJob *crowd, const Packing *packing, size_t count, const uint8_t *fluid,
                         const float *position)
{
    const WorldDef *def = packing->def;
    *crowd = (PackingJob){.fluid = count, .count = count, .h = def->support * def->spacing, .def = def};
    for (int a = 0; a < 3; a++)
        crowd->cells[a] = a < def->dimensions ? (int)fmax(1, floor(def->box_size[a] / crowd->h)) : 1;
    const size_t all = count + packing->boundary->count;
    crowd->position = malloc((3 * all + 3) * sizeof *crowd->position);
    crowd->order = malloc((all + 1) * sizeof *crowd->order);
    crowd->near = malloc((count + 1) * sizeof *crowd->near);
    crowd->begin = malloc((cell_count(crowd) + 2) * sizeof *crowd->begin);
    if (!crowd->position || !crowd->order || !crowd->near || !crowd->begin)
        return false;
    memcpy(crowd->position, position, 3 * count * sizeof *position);
    for (int k = 0; k < def->solid_count; k++)
        solid_pose(&def->solids[k], 0, &crowd->pose[k]);
    add_boundary(crowd, packing->boundary);
    for (size_t i = 0; i < count; i++)
        if (packing->take[fluid[i]] && within(def, crowd->pose, def->solid_count, position + 3 * i, crowd->h))
            crowd->near[crowd->near_count++] = (uint32_t)i;
    crowd->way = malloc((3 * crowd->near_count + 1) * sizeof *crowd->way);
    return crowd->way;
}

static void crowd_destroy(PackingJob *crowd)
{
    free(crowd->position);
    free(crowd->order);
    free(crowd->near);
    free(crowd->begin);
    free(crowd->way);
}

/* Take all ways at once, except ways into a solid. */
static void take_ways(PackingJob *crowd)
{
    const WorldDef *def = crowd->def;
    for (size_t k = 0; k < crowd->near_count; k++) {
        float *x = crowd->position + 3 * (size_t)crowd->near[k], to[3];
        for (int a = 0; a < 3; a++)
            to[a] = x[a] + (float)crowd->way[3 * k + (size_t)a];
        if (!within(def, crowd->pose, def->solid_count, to, 0))
            memcpy(x, to, sizeof to);
    }
}

bool packing_settle(const Packing *packing, size_t count, const uint8_t *fluid, float *position)
{
    PackingJob crowd;
    const bool ok = crowd_create(&crowd, packing, count, fluid, position);
    for (int round = 0; ok && round < ROUNDS; round++) {
        sort(&crowd);
        for (size_t k = 0; k < crowd.near_count; k++)
            find_way(&crowd, packing->lattice, crowd.near[k], crowd.way + 3 * k);
        take_ways(&crowd);
    }
    if (ok)
        memcpy(position, crowd.position, 3 * count * sizeof *position);
    crowd_destroy(&crowd);
    return ok;
}
