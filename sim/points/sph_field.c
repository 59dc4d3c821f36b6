#include "sim/points/points.h"

#include "sim/kernel/kernel.h"
#include "sim/points/walk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double cells_most = 0x1p24; /* larger cells for widely spread particles */
static const double step = 0.15;         /* of h: 30 % of the particle spacing, h / 2 */

static const float FLUID_LEAST = 0.5F; /* F at the fluid's surface */

struct SphField {
    size_t count, capacity;
    float *column[5]; /* x, y, z (m), V (m3), V s, by cell, with stride `room`; readable for LANES - 1
                         entries past the last */
    double low[3], high[3], cell, support; /* m: bounds of the particles; cell size, at least the support */
    int size[3];                           /* cells, from low on */
    uint32_t *begin;                       /* first particle of each cell; the last entry is the end */
};

/* ---- sums about a position ---- */

/* Sums of V W with W = C t^3, t = 1 - r^2 / h^2, per lane. Powers of t, without the common factors of
   derivatives: grad = -6 C / h^2 t^2 x, H = -6 C / h^2 (t^2 - 4 t x x / h^2). */
typedef struct SphSum {
    f8 value, squares, slope[3], straight[3], across[3]; /* t^3; t^2; t^2 x; t x x; t x y, t y z, t z x */
} SphSum;

SIMD_INLINE void add_eight(const SphField *sph, const float *weight, size_t i, size_t end, const float p[3],
                           SphSum *sum)
{
    const f8 one = f8_splat(1), square = f8_splat((float)(1 / (sph->support * sph->support)));
    const f8 x = f8_splat(p[0]) - f8_load(sph->column[0] + i),
             y = f8_splat(p[1]) - f8_load(sph->column[1] + i);
    const f8 z = f8_splat(p[2]) - f8_load(sph->column[2] + i), left = one - (x * x + y * y + z * z) * square;
    const i8 near = (left > f8_splat(0)) & (lane_index < (int32_t)(end - i < LANES ? end - i : LANES));
    const f8 t = f8_select(near, left, f8_splat(0));
    const f8 v = f8_select(near, f8_load(weight + i), f8_splat(0)), once = v * t, twice = once * t;
    sum->value += twice * t;
    sum->squares += twice;
    sum->slope[0] += twice * x;
    sum->slope[1] += twice * y;
    sum->slope[2] += twice * z;
    sum->straight[0] += once * x * x;
    sum->straight[1] += once * y * y;
    sum->straight[2] += once * z * z;
    sum->across[0] += once * x * y;
    sum->across[1] += once * y * z;
    sum->across[2] += once * z * x;
}

static int cell_along(const SphField *sph, int axis, double x)
{
    const double at = (x - sph->low[axis]) / sph->cell;
    return at > -1 ? at < sph->size[axis] + 1 ? (int)floor(at) : sph->size[axis] + 1 : -2;
}

/* The particles in up to three adjacent cells along x, which are contiguous. */
SIMD_INLINE void add_row(const SphField *sph, const float *weight, const int from[3], const int to[3], int y,
                         int z, const float p[3], SphSum *sum)
{
    const size_t row = (size_t)sph->size[0] * ((size_t)y + (size_t)sph->size[1] * (size_t)z);
    const size_t end = sph->begin[row + (size_t)to[0] + 1];
    for (size_t i = sph->begin[row + (size_t)from[0]]; i < end; i += LANES)
        add_eight(sph, weight, i, end, p, sum);
}

SIMD_INLINE void sum_about(const SphField *sph, const float *weight, const float p[3], SphSum *sum)
{
    int from[3], to[3];
    memset(sum, 0, sizeof *sum);
    for (int k = 0; k < 3; k++) {
        const int cell = isfinite(p[k]) ? cell_along(sph, k, (double)p[k]) : -2;
        from[k] = cell > 0 ? cell - 1 : 0;
        to[k] = cell + 1 < sph->size[k] ? cell + 1 : sph->size[k] - 1;
        if (from[k] > to[k])
            return;
    }
    for (int z = from[2]; z <= to[2]; z++)
        for (int y = from[1]; y <= to[1]; y++)
            add_row(sph, weight, from, to, y, z, p, sum);
}

SIMD_INLINE float total(f8 a)
{
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

/* Sums at eight positions, with factors: value, slope, second derivatives. */
typedef struct SphLanes {
    LaneSample s;
    f8 straight[3], across[3];
} SphLanes;

SIMD_INLINE void sum_lanes(const SphField *sph, const float *weight, const LanePlace *p, SphLanes *out)
{
    const float most = (float)kernel_poly6(0, sph->support),
                square = (float)(1 / (sph->support * sph->support));
    const float slope = -6 * most * square, bend = -4 * square;
    for (int lane = 0; lane < LANES; lane++) {
        SphSum sum;
        sum_about(sph, weight, (float[3]){p->x[lane], p->y[lane], p->z[lane]}, &sum);
        const float squares = total(sum.squares);
        out->s.value[lane] = most * total(sum.value);
        out->s.x[lane] = slope * total(sum.slope[0]);
        out->s.y[lane] = slope * total(sum.slope[1]);
        out->s.z[lane] = slope * total(sum.slope[2]);
        for (int k = 0; k < 3; k++) {
            out->straight[k][lane] = slope * (squares + bend * total(sum.straight[k]));
            out->across[k][lane] = slope * bend * total(sum.across[k]);
        }
    }
}

SIMD_INLINE void sph_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    const SphField *sph = field->own;
    SphLanes sum;
    sum_lanes(sph, sph->column[3], p, &sum);
    *out = sum.s;
    out->bend = lane_bend(out, sum.straight, sum.across);
}

/* Returns F. s = A / F: grad s = (grad A - s grad F) / F; H s = (H A - s H F - grad s grad F - grad F grad s)
 * / F. */
SIMD_INLINE f8 scalar_and_fluid(const SphField *sph, const LanePlace *p, LaneSample *out)
{
    SphLanes f, a;
    sum_lanes(sph, sph->column[3], p, &f);
    sum_lanes(sph, sph->column[4], p, &a);
    const i8 any = f.s.value > f8_splat(0);
    const f8 none = f8_splat(0), inverse = f8_select(any, f8_splat(1) / f.s.value, none),
             s = a.s.value * inverse;
    *out = (LaneSample){s, (a.s.x - s * f.s.x) * inverse, (a.s.y - s * f.s.y) * inverse,
                        (a.s.z - s * f.s.z) * inverse, none};
    const f8 g[3] = {out->x, out->y, out->z}, h[3] = {f.s.x, f.s.y, f.s.z};
    f8 straight[3], across[3];
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3;
        straight[k] = (a.straight[k] - s * f.straight[k] - f8_splat(2) * g[k] * h[k]) * inverse;
        across[k] = (a.across[k] - s * f.across[k] - g[k] * h[l] - g[l] * h[k]) * inverse;
    }
    out->bend = lane_bend(out, straight, across);
    return f.s.value;
}

SIMD_INLINE void sph_scalar_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    (void)scalar_and_fluid(field->own, p, out);
}

SIMD_INLINE void sph_inside_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    const f8 none = f8_splat(0);
    const i8 inside = scalar_and_fluid(field->own, p, out) >= f8_splat(FLUID_LEAST);
    out->x = f8_select(inside, out->x, none);
    out->y = f8_select(inside, out->y, none);
    out->z = f8_select(inside, out->z, none);
}

/* Data for shaders/surface/sph_sum.glsl. */
static void sph_parts(const LevelField *field, LevelParts *out)
{
    const SphField *sph = field->own;
    const uint32_t column = (uint32_t)sph->capacity;
    size_t cells = 1;
    for (int k = 0; k < 3; k++) {
        out->number[k] = (float)sph->low[k];
        out->number[4 + k] = (float)sph->size[k];
        cells *= (size_t)sph->size[k];
    }
    out->number[3] = (float)sph->cell;
    out->number[7] = (float)sph->support;
    out->number[8] = (float)kernel_poly6(0, sph->support);
    memcpy(&out->number[9], &column, sizeof column);
    out->array[0].data = sph->column[0];
    out->array[0].bytes = 5 * sph->capacity * sizeof(float);
    out->array[1].data = sph->begin;
    out->array[1].bytes = (cells + 1) * sizeof *sph->begin;
}

LEVEL_KIND_OF(sph, sph_parts)
LEVEL_KIND_OF(sph_scalar, sph_parts)
LEVEL_KIND(sph_inside)

/* ---- particles by cell ---- */

static bool counts(const FieldParticles *particles, size_t i)
{
    const float *p = particles->position + 4 * i;
    return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]) && isfinite(p[3]) &&
           (!particles->scalar || isfinite(particles->scalar[i]));
}

static size_t cell_of(const SphField *sph, const float p[3])
{
    size_t cell[3];
    for (int k = 0; k < 3; k++) {
        const int at = cell_along(sph, k, (double)p[k]);
        cell[k] = (size_t)(at < 0 ? 0 : at < sph->size[k] ? at : sph->size[k] - 1);
    }
    return cell[0] + (size_t)sph->size[0] * (cell[1] + (size_t)sph->size[1] * cell[2]);
}

static size_t set_cells(SphField *sph)
{
    double cells = HUGE_VAL;
    for (sph->cell = sph->support; cells > cells_most; sph->cell *= 1.5) {
        cells = 1;
        for (int k = 0; k < 3; k++)
            cells *= floor((sph->high[k] - sph->low[k]) / sph->cell) + 1;
        if (cells <= cells_most)
            break;
    }
    for (int k = 0; k < 3; k++)
        sph->size[k] = (int)floor((sph->high[k] - sph->low[k]) / sph->cell) + 1;
    return (size_t)cells;
}

/* Counting sort that keeps the particles' order within a cell. */
static void sort(SphField *sph, size_t cells, const FieldParticles *particles)
{
    size_t total_so_far = 0;
    for (size_t i = 0; i < particles->count; i++)
        if (counts(particles, i))
            sph->begin[cell_of(sph, particles->position + 4 * i)]++;
    for (size_t c = 0; c <= cells; c++) {
        const uint32_t here = sph->begin[c];
        sph->begin[c] = (uint32_t)total_so_far;
        total_so_far += here;
    }
    sph->count = total_so_far;
    for (size_t i = 0; i < particles->count; i++) {
        const float *p = particles->position + 4 * i;
        if (!counts(particles, i))
            continue;
        const size_t to = sph->begin[cell_of(sph, p)]++;
        for (int k = 0; k < 4; k++)
            sph->column[k][to] = p[k];
        sph->column[4][to] = particles->scalar ? p[3] * particles->scalar[i] : 0;
    }
    memmove(sph->begin + 1, sph->begin, cells * sizeof *sph->begin);
    sph->begin[0] = 0;
}

SphField *sph_field_create(const FieldParticles *particles, Error *error)
{
    double low[3], high[3];
    if (!(particles->support > 0) || !field_bounds(particles, low, high)) {
        error_set(error, "there is no particle to make a field of");
        return NULL;
    }
    SphField *sph = calloc(1, sizeof *sph);
    float *columns = calloc(5 * (particles->count + LANES), sizeof *columns);
    size_t cells = 0;
    if (sph) {
        memcpy(sph->low, low, sizeof low);
        memcpy(sph->high, high, sizeof high);
        sph->support = particles->support;
        cells = set_cells(sph);
        sph->column[0] = columns;
        sph->capacity = particles->count + LANES;
        sph->begin = calloc(cells + 1, sizeof *sph->begin);
    }
    if (!sph || !columns || !sph->begin) {
        error_set(error, "no memory for the field of %zu particles", particles->count);
        sph_field_destroy(sph);
        if (!sph)
            free(columns);
        return NULL;
    }
    for (size_t k = 1; k < 5; k++)
        sph->column[k] = columns + k * sph->capacity;
    sort(sph, cells, particles);
    return sph;
}

void sph_field_destroy(SphField *field)
{
    if (!field)
        return;
    free(field->column[0]);
    free(field->begin);
    free(field);
}

static LevelField field_of(const SphField *from, const LevelKind *kind)
{
    LevelField field = {.kind = kind, .number = {0}};
    for (int k = 0; k < 3; k++) {
        field.low[k] = from->low[k] - from->support;
        field.high[k] = from->high[k] + from->support;
        field.march[k] = 0.25 * from->support;
    }
    field.own = from;
    field.length = from->support;
    field.step = step * from->support;
    return field;
}

LevelField level_sph(const SphField *from)
{
    return field_of(from, &sph_kind);
}

LevelField level_sph_inside(const SphField *from)
{
    return field_of(from, &sph_inside_kind);
}

LevelField level_sph_scalar(const SphField *from)
{
    return field_of(from, &sph_scalar_kind);
}
