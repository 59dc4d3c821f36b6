#include "sim/base/base.h"
#include "sim/base/simd.h"
#include "sim/kernel/kernel.h"
#include "sim/mesh.h"

#include <math.h>
#include <string.h>

enum { SLAB = 8 }; /* slices in a slab: 8 slices of 128^2 values stay in a core's cache */

size_t volume_grid_cells(const VolumeGrid *grid)
{
    return (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2];
}

static bool counts(const FieldParticles *particles, size_t i)
{
    const float *p = particles->position + 4 * i;
    const bool scalar = !particles->scalar || isfinite(particles->scalar[i]);
    return scalar && isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]) && isfinite(p[3]);
}

bool field_bounds(const FieldParticles *particles, double low[3], double high[3])
{
    for (int k = 0; k < 3; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    for (size_t i = 0; i < particles->count; i++)
        for (int k = 0; counts(particles, i) && k < 3; k++) {
            low[k] = fmin(low[k], particles->position[4 * i + k]);
            high[k] = fmax(high[k], particles->position[4 * i + k]);
        }
    return low[0] <= high[0];
}

double field_at(const FieldParticles *particles, const double r[3], double *weighted)
{
    double sum = 0, sum_weighted = 0;
    for (size_t i = 0; i < particles->count; i++) {
        const float *p = particles->position + 4 * i;
        const double d[3] = {r[0] - p[0], r[1] - p[1], r[2] - p[2]};
        if (!counts(particles, i))
            continue;
        const double distance = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const double weight = p[3] * kernel_poly6(distance, particles->support);
        sum += weight;
        sum_weighted += particles->scalar ? weight * particles->scalar[i] : 0;
    }
    if (weighted)
        *weighted = sum_weighted;
    return sum;
}

/* ---- particles within reach of each slab ---- */

/* The least integer >= x, and the least integer > x, limited to 0 .. size. */
static int whole_from(double x, int size)
{
    const double bounded = x < 0 ? 0 : x > size ? size : x;
    return (int)bounded + (bounded > (int)bounded);
}

static int whole_above(double x, int size)
{
    return x < 0 ? 0 : x >= size ? size : (int)x + 1;
}

/* The values within h of coordinate x along an axis: first <= i < end, none where first >= end. */
static void reached(const FieldParticles *particles, const VolumeGrid *grid, int axis, float x, int *first,
                    int *end)
{
    const double at = (x - grid->corner[axis]) / grid->cell - 0.5, reach = particles->support / grid->cell;
    *first = whole_from(at - reach, grid->size[axis]);
    *end = whole_above(at + reach, grid->size[axis]);
}

/* ---- the sums of a slab ---- */

typedef struct FieldSumJob {
    const FieldParticles *particles;
    const VolumeGrid *grid;
    const Bins *slabs;
    float *field, *weighted;
} FieldSumJob;

/* Slabs within reach of particle i. */
static BinSpan reached_slabs(const void *context, size_t i)
{
    const FieldSumJob *sum = context;
    int slice = 0, slice_end = 0;
    if (counts(sum->particles, i))
        reached(sum->particles, sum->grid, 2, sum->particles->position[4 * i + 2], &slice, &slice_end);
    const size_t first = (size_t)slice / SLAB;
    return (BinSpan){first, slice < slice_end ? (size_t)(slice_end - 1) / SLAB + 1 : first};
}

void field_slabs_free(FieldSlabs *slabs)
{
    bins_free(&slabs->bins);
}

/* A particle's contribution in grid units: V W = most (1 - q^2)^3, q = r / h; Müller 2003, eq. 20. */
typedef struct ParticleKernel {
    int first[3], end[3]; /* range of grid values within reach */
    float at[3];          /* position relative to the first value, cells */
    float most, inverse;  /* V W(0); 1 / (h / cell)^2 */
} ParticleKernel;

enum { ROW = 256 }; /* values along x in a piece of a row */

/* Adds most (1 - q^2)^3, where q^2 = square + 1 - left. */
SIMD_INLINE void add_row(float *restrict row, const float *restrict square, int count, float left, float most)
{
    int i = 0;
    for (; i + LANES <= count; i += LANES) {
        const f8 u = f8_positive(left - f8_load(square + i));
        f8_store(row + i, f8_load(row + i) + most * (u * u * u));
    }
    for (; i < count; i++) {
        const float t = left - square[i], u = t > 0 ? t : 0;
        row[i] += most * (u * u * u);
    }
}

/* Adds to the values first <= i < first + count of each row. Rounds count up to whole registers if the row
   has room: values beyond the bump get 0. */
SIMD_INLINE void add_rows(float *values, const VolumeGrid *grid, const ParticleKernel *bump, int first,
                          int count)
{
    float square[ROW];
    const int width = grid->size[0], height = grid->size[1], whole = (count + LANES - 1) / LANES * LANES;
    count = first + whole <= width ? whole : count;
    for (int i = 0; i < count; i++) {
        const float d = (float)(first + i) - bump->at[0];
        square[i] = bump->inverse * d * d;
    }
    for (int k = bump->first[2]; k < bump->end[2]; k++)
        for (int j = bump->first[1]; j < bump->end[1]; j++) {
            const float dy = (float)j - bump->at[1], dz = (float)k - bump->at[2];
            const float left = 1 - (dy * dy + dz * dz) * bump->inverse;
            if (left > 0)
                add_row(values + (size_t)width * ((size_t)j + (size_t)height * (size_t)k) + first, square,
                        count, left, bump->most);
        }
}

SIMD_INLINE void add_pieces(float *values, const VolumeGrid *grid, const ParticleKernel *bump)
{
    for (int i = bump->first[0]; i < bump->end[0]; i += ROW)
        add_rows(values, grid, bump, i, bump->end[0] - i < ROW ? bump->end[0] - i : ROW);
}

static SIMD_WIDE void add_wide(float *values, const VolumeGrid *grid, const ParticleKernel *bump)
{
    add_pieces(values, grid, bump);
}

static void add_bump(float *values, const VolumeGrid *grid, const ParticleKernel *bump)
{
    if (simd_wide())
        add_wide(values, grid, bump);
    else
        add_pieces(values, grid, bump);
}

static void sum_member(const FieldSumJob *sum, size_t i, int slice, int slice_end)
{
    const FieldParticles *particles = sum->particles;
    const VolumeGrid *grid = sum->grid;
    const float *p = particles->position + 4 * i;
    const double reach = particles->support / grid->cell;
    ParticleKernel bump = {.most = (float)(p[3] * kernel_poly6(0, particles->support)),
                           .inverse = (float)(1 / (reach * reach))};
    for (int k = 0; k < 3; k++) {
        reached(particles, grid, k, p[k], &bump.first[k], &bump.end[k]);
        bump.at[k] = (float)((p[k] - grid->corner[k]) / grid->cell - 0.5);
    }
    bump.first[2] = bump.first[2] > slice ? bump.first[2] : slice;
    bump.end[2] = bump.end[2] < slice_end ? bump.end[2] : slice_end;
    if (sum->field)
        add_bump(sum->field, grid, &bump);
    if (!sum->weighted)
        return;
    bump.most *= particles->scalar[i];
    add_bump(sum->weighted, grid, &bump);
}

static void sum_slab(void *context, size_t slab, size_t slab_end)
{
    const FieldSumJob *sum = context;
    const size_t slice_cells = (size_t)sum->grid->size[0] * (size_t)sum->grid->size[1];
    for (; slab < slab_end; slab++) {
        const int depth = sum->grid->size[2], slice = (int)slab * SLAB;
        const int slice_end = slice + SLAB < depth ? slice + SLAB : depth;
        const size_t from = slice_cells * (size_t)slice, cells = slice_cells * (size_t)(slice_end - slice);
        if (sum->field)
            memset(sum->field + from, 0, cells * sizeof *sum->field);
        if (sum->weighted)
            memset(sum->weighted + from, 0, cells * sizeof *sum->weighted);
        for (size_t m = sum->slabs->begin[slab]; m < sum->slabs->begin[slab + 1]; m++)
            sum_member(sum, sum->slabs->member[m], slice, slice_end);
    }
}

bool field_sum(const FieldParticles *particles, const VolumeGrid *grid, int threads, FieldSlabs *slabs,
               float *field, float *weighted, Error *error)
{
    const size_t count = ((size_t)grid->size[2] + SLAB - 1) / SLAB;
    FieldSumJob sum = {particles, grid, &slabs->bins, field, particles->scalar ? weighted : NULL};
    if (!bins_fill(&slabs->bins, count, particles->count, reached_slabs, &sum))
        return error_set(error, "no memory to sum the field of %zu particles", particles->count);
    parallel_ranges(threads, count, 1, sum_slab, &sum);
    return true;
}
