#include "sim/points/points.h"

#include "sim/points/walk.h"

#include <math.h>

static const double paper = 0.3; /* of a cell: sqrt(2 dt), Tanaka et al. 2012, section 4 */

/* A position along an axis: index of the value before, and distance beyond, in cells. */
typedef struct GridInterval {
    i8 first; /* 0 .. size - 2 */
    f8 part, inverse;
} GridInterval;

SIMD_INLINE GridInterval between(const VolumeData *volume, int axis, f8 x)
{
    const f8 inverse = f8_splat((float)(1 / volume->spacing[axis]));
    const f8 at = (x - f8_splat((float)volume->corner[axis])) * inverse;
    const f8 bounded = lesser(greater(at, f8_splat(0)), f8_splat((float)(volume->size[axis] - 2)));
    const i8 first = f8_truncate(bounded);
    return (GridInterval){first, at - f8_from(first), inverse};
}

SIMD_INLINE const float *value_at(const VolumeData *volume, int x, int y, int z)
{
    return volume->value + (size_t)x +
           (size_t)volume->size[0] * ((size_t)y + (size_t)volume->size[1] * (size_t)z);
}

SIMD_INLINE f8 mixed(f8 a, f8 b, f8 part)
{
    return a + part * (b - a);
}

/* The eight values around each position: [x + 2 y + 4 z]. */
SIMD_INLINE void corners(const VolumeData *volume, const GridInterval at[3], f8 value[8])
{
    const size_t row = (size_t)volume->size[0], slice = row * (size_t)volume->size[1];
    for (int lane = 0; lane < LANES; lane++) {
        const float *v = value_at(volume, at[0].first[lane], at[1].first[lane], at[2].first[lane]);
        value[0][lane] = v[0];
        value[1][lane] = v[1];
        value[2][lane] = v[row];
        value[3][lane] = v[row + 1];
        value[4][lane] = v[slice];
        value[5][lane] = v[slice + 1];
        value[6][lane] = v[slice + row];
        value[7][lane] = v[slice + row + 1];
    }
}

SIMD_INLINE void trilinear_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    const VolumeData *volume = field->own;
    const GridInterval at[3] = {between(volume, 0, p->x), between(volume, 1, p->y), between(volume, 2, p->z)};
    const f8 x = at[0].part, y = at[1].part, z = at[2].part, none = f8_splat(0);
    f8 v[8], slope[4], middle[4];
    corners(volume, at, v);
    for (int k = 0; k < 4; k++) {
        slope[k] = v[2 * k + 1] - v[2 * k];
        middle[k] = v[2 * k] + x * slope[k];
    }
    const f8 low = middle[1] - middle[0], high = middle[3] - middle[2];
    *out = (LaneSample){mixed(mixed(middle[0], middle[1], y), mixed(middle[2], middle[3], y), z),
                        mixed(mixed(slope[0], slope[1], y), mixed(slope[2], slope[3], y), z) * at[0].inverse,
                        mixed(low, high, z) * at[1].inverse,
                        mixed(middle[2] - middle[0], middle[3] - middle[1], y) * at[2].inverse, none};
    const f8 straight[3] = {none, none, none};
    const f8 across[3] = {mixed(slope[1] - slope[0], slope[3] - slope[2], z) * at[0].inverse * at[1].inverse,
                          (high - low) * at[1].inverse * at[2].inverse,
                          mixed(slope[2] - slope[0], slope[3] - slope[1], y) * at[2].inverse * at[0].inverse};
    out->bend = lane_bend(out, straight, across);
}

/* Weights of the four values around a position, for value, slope and second derivative, per cell. */
typedef struct Spline {
    f8 value[4], slope[4], bend[4];
} Spline;

SIMD_INLINE Spline spline(f8 part)
{
    const f8 half = f8_splat(0.5F), one = f8_splat(1), two = f8_splat(2), three = f8_splat(3),
             four = f8_splat(4);
    const f8 five = f8_splat(5), eight = f8_splat(8), nine = f8_splat(9), ten = f8_splat(10);
    const f8 t = lesser(greater(part, -half), one + half), t2 = t * t, t3 = t2 * t;
    return (Spline){{half * (two * t2 - t - t3), half * (two - five * t2 + three * t3),
                     half * (t + four * t2 - three * t3), half * (t3 - t2)},
                    {half * (four * t - one - three * t2), half * (nine * t2 - ten * t),
                     half * (one + eight * t - nine * t2), half * (three * t2 - two * t)},
                    {two - three * t, nine * t - five, four - nine * t, three * t - one}};
}

SIMD_INLINE int held(int i, int size)
{
    return i < 0 ? 0 : i < size ? i : size - 1;
}

/* Four values along x per lane; y and z count from two values before. */
SIMD_INLINE void row_of(const VolumeData *volume, const GridInterval at[3], int y, int z, f8 value[4])
{
    for (int lane = 0; lane < LANES; lane++) {
        const float *row = value_at(volume, 0, held(at[1].first[lane] + y - 1, volume->size[1]),
                                    held(at[2].first[lane] + z - 1, volume->size[2]));
        const int x = at[0].first[lane];
        value[0][lane] = row[x > 0 ? x - 1 : 0];
        value[1][lane] = row[x];
        value[2][lane] = row[x + 1];
        value[3][lane] = row[held(x + 2, volume->size[0])];
    }
}

SIMD_INLINE f8 weighed(const f8 weight[4], const f8 value[4])
{
    return (weight[0] * value[0] + weight[1] * value[1]) + (weight[2] * value[2] + weight[3] * value[3]);
}

/* Sums over a slice's rows: letters name the axes of derivatives. */
typedef struct Slice {
    f8 none, x, y, xx, xy, yy;
} Slice;

SIMD_INLINE Slice slice_of(const VolumeData *volume, const GridInterval at[3], const Spline *along_x,
                           const Spline *along_y, int z)
{
    f8 value[4], none[4], slope[4], bend[4];
    for (int y = 0; y < 4; y++) {
        row_of(volume, at, y, z, value);
        none[y] = weighed(along_x->value, value);
        slope[y] = weighed(along_x->slope, value);
        bend[y] = weighed(along_x->bend, value);
    }
    return (Slice){weighed(along_y->value, none),  weighed(along_y->value, slope),
                   weighed(along_y->slope, none),  weighed(along_y->value, bend),
                   weighed(along_y->slope, slope), weighed(along_y->bend, none)};
}

SIMD_INLINE void catmull_rom_at(const LevelField *field, const LanePlace *p, LaneSample *out)
{
    const VolumeData *volume = field->own;
    const GridInterval at[3] = {between(volume, 0, p->x), between(volume, 1, p->y), between(volume, 2, p->z)};
    const Spline along[3] = {spline(at[0].part), spline(at[1].part), spline(at[2].part)};
    const f8 x = at[0].inverse, y = at[1].inverse, z = at[2].inverse, zero = f8_splat(0);
    f8 straight[3] = {zero, zero, zero}, across[3] = {zero, zero, zero};
    *out = (LaneSample){zero, zero, zero, zero, zero};
    for (int k = 0; k < 4; k++) {
        const Slice s = slice_of(volume, at, &along[0], &along[1], k);
        const f8 value = along[2].value[k], slope = along[2].slope[k];
        out->value += value * s.none;
        out->x += value * s.x * x;
        out->y += value * s.y * y;
        out->z += slope * s.none * z;
        straight[0] += value * s.xx * x * x;
        straight[1] += value * s.yy * y * y;
        straight[2] += along[2].bend[k] * s.none * z * z;
        across[0] += value * s.xy * x * y;
        across[1] += slope * s.y * y * z;
        across[2] += slope * s.x * z * x;
    }
    out->bend = lane_bend(out, straight, across);
}

/* Data for shaders/surface/grid.glsl. */
static void grid_parts(const LevelField *field, LevelParts *out)
{
    const VolumeData *volume = field->own;
    size_t count = 1;
    for (int k = 0; k < 3; k++) {
        out->number[k] = (float)volume->corner[k];
        out->number[4 + k] = (float)(1 / volume->spacing[k]);
        out->number[8 + k] = (float)volume->size[k];
        count *= (size_t)volume->size[k];
    }
    out->array[0].data = volume->value;
    out->array[0].bytes = count * sizeof *volume->value;
}

LEVEL_KIND_OF(trilinear, grid_parts)
LEVEL_KIND_OF(catmull_rom, grid_parts)

static const LevelKind *const kinds[] = {&trilinear_kind, &catmull_rom_kind};

const char *volume_interpolation_name(VolumeInterpolation interpolation)
{
    return interpolation < VOLUME_INTERPOLATIONS ? kinds[interpolation]->name : NULL;
}

VolumeData volume_of_grid(const VolumeGrid *grid, const float *value)
{
    VolumeData volume = {.value = value};
    for (int k = 0; k < 3; k++) {
        volume.size[k] = grid->size[k];
        volume.corner[k] = grid->corner[k] + 0.5 * grid->cell;
        volume.spacing[k] = grid->cell;
    }
    return volume;
}

static bool numbers(const VolumeData *volume, Error *error)
{
    const size_t width = (size_t)volume->size[0], height = (size_t)volume->size[1];
    const size_t count = width * height * (size_t)volume->size[2];
    size_t bad = 0, first = 0;
    for (size_t i = 0; i < count; i++)
        if (!isfinite(volume->value[i]) && bad++ == 0)
            first = i;
    return bad == 0 ||
           error_set(error, "%zu value%s of the volume %s no number, the first at [%zu, %zu, %zu]", bad,
                     plural(bad), bad == 1 ? "is" : "are", first % width, first / width % height,
                     first / width / height);
}

bool level_volume(const VolumeData *volume, VolumeInterpolation interpolation, LevelField *field,
                  Error *error)
{
    double cell = HUGE_VAL;
    *field = (LevelField){.kind = kinds[interpolation], .number = {0}};
    for (int k = 0; k < 3; k++) {
        if (volume->size[k] < 2)
            return error_set(error, "the volume has %d value%s along %c; it needs 2 or more", volume->size[k],
                             plural((size_t)volume->size[k]), "xyz"[k]);
        if (!(volume->spacing[k] > 0) || !isfinite(volume->spacing[k]) || !isfinite(volume->corner[k]))
            return error_set(
                error,
                "the volume's values along %c are %g m apart, from %g m on; give finite numbers, "
                "the first above 0",
                "xyz"[k], volume -> spacing[k], volume -> corner[k]);
        field->low[k] = volume->corner[k];
        field->high[k] = volume->corner[k] + (volume->size[k] - 1) * volume->spacing[k];
        field->march[k] = volume->spacing[k];
        cell = fmin(cell, volume->spacing[k]);
    }
    field->own = volume;
    field->length = cell;
    field->step = paper * cell;
    return numbers(volume, error);
}
