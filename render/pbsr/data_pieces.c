#include "render/pbsr/data_pieces.h"

#include "render/pbsr/opacity.h"

#include <math.h>
#include <string.h>

bool data_pieces_are(const PbsrLayer *said)
{
    return pbsr_of_file(said) && said->of >= PBSR_VOLUME && said->of <= PBSR_SLICE_Z;
}

/* Side of the data's block of cells around all values, m. */
static double side_of(const VolumeData *volume, int axis)
{
    return volume->spacing[axis] * volume->size[axis];
}

double data_pieces_density(const PbsrLayer *said)
{
    const VolumeData *volume = &said->data->volume;
    const double side = fmin(side_of(volume, 0), fmin(side_of(volume, 1), side_of(volume, 2)));
    return point_density_of_opacity(said->opacity, said->of == PBSR_VOLUME ? side : 1);
}

static void value_place(const VolumeData *volume, const size_t index[3], double place[3])
{
    for (int k = 0; k < 3; k++)
        place[k] = volume->corner[k] + volume->spacing[k] * (double)index[k];
}

static LayerPoint point_at(const double place[3], float value, float inside)
{
    return (LayerPoint){
        .at = {(float)place[0], (float)place[1], (float)place[2]}, .value = value, .inside = inside};
}

/* ---- slices ---- */

/* Adds the two triangles of the square with the first corner `first`, in rows of `width` points. */
static void add_square(Layer *out, size_t first, size_t width)
{
    const uint32_t at = (uint32_t)first, up = (uint32_t)width;
    const uint32_t two[2][3] = {{at, at + 1, at + up}, {at + 1, at + up + 1, at + up}};
    memcpy(out->triangle + out->triangle_count, two, sizeof two);
    out->triangle_count += 2;
}

static bool make_slice(const VolumeData *volume, const LevelField *field, int axis, double level, Layer *out,
                       Error *error)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const size_t width = (size_t)volume->size[u], count = width * (size_t)volume->size[v];
    if (!(level >= field->low[axis] && level <= field->high[axis]))
        return error_set(error, "the slice at %g m is beside the data, which are at %g to %g m", level,
                         field->low[axis], field->high[axis]);
    if (count > UINT32_MAX || !layer_reserve(out, count, 2 * count))
        return error_set(error, "no memory for a slice of %zu values", count);
    for (size_t i = 0; i < count; i++) {
        const size_t column = i % width, row = i / width;
        size_t index[3] = {0};
        double place[3];
        LevelSample sample;
        index[u] = column;
        index[v] = row;
        value_place(volume, index, place);
        place[axis] = level;
        level_at(field, place, &sample);
        out->point[out->point_count++] = point_at(place, sample.value, 1);
        if (column + 1 < width && i + width < count)
            add_square(out, i, width);
    }
    return true;
}

/* ---- the cloud ---- */

/* Linear, from 0 at the level to 1 at the largest value. */
static float density_of(const PbsrLayer *said, float value)
{
    const float level = (float)said->level;
    return (value - level) / (said->data->high - level);
}

static bool make_cloud(const PbsrLayer *said, Layer *out, Error *error)
{
    const VolumeData *volume = &said->data->volume;
    const size_t width = (size_t)volume->size[0], height = (size_t)volume->size[1],
                 all = width * height * (size_t)volume->size[2];
    size_t count = 0;
    for (size_t i = 0; i < all; i++)
        count += volume->value[i] > (float)said->level;
    if (count == 0)
        return error_set(error, "no value is above the level %g: they are %g to %g", said->level,
                         (double)said->data->low, (double)said->data->high);
    if (!layer_reserve(out, count, 0))
        return error_set(error, "no memory for a cloud of %zu cells", count);
    memcpy(out->cell, volume->spacing, sizeof out->cell);
    for (size_t i = 0; i < all; i++) {
        const size_t row = i / width, index[3] = {i % width, row % height, row / height};
        double place[3];
        if (!(volume->value[i] > (float)said->level))
            continue;
        value_place(volume, index, place);
        out->point[out->point_count++] =
            point_at(place, volume->value[i], density_of(said, volume->value[i]));
    }
    return true;
}

bool data_pieces_make(const PbsrLayer *said, const LevelField *field, unsigned number, Layer *out,
                      Error *error)
{
    out->number = number;
    out->point_count = out->triangle_count = 0;
    return said->of == PBSR_VOLUME
               ? make_cloud(said, out, error)
               : make_slice(&said->data->volume, field, said->of - PBSR_SLICE_X, said->level, out, error);
}
