#include "app/export/point_color.h"

#include <math.h>
#include <string.h>

bool point_colored(const PointColors *colors)
{
    return colors->mapped || colors->count > 0;
}

double point_scalar(const SnapshotStep *step, size_t i, Scalar scalar)
{
    const double x = step->velocity[0][i], y = step->velocity[1][i], z = step->velocity[2][i];
    if (scalar == SCALAR_SPEED)
        return sqrt(x * x + y * y + z * z);
    return scalar == SCALAR_DENSITY ? step->density[i] : step->pressure[i];
}

static const char *map_of(const PointColors *colors)
{
    return colormap_of(colormap_choices[0], colors->scalar);
}

void point_colors_print(FILE *file, const char *before, const PointColors *colors)
{
    if (colors->mapped)
        fprintf(file, "%scolours: %s, %s from %g to %g %s\n", before, map_of(colors),
                scalar_name(colors->scalar), colors->low, colors->high, scalar_unit(colors->scalar));
}

static void fluid_color(const PointColors *colors, int32_t fluid, uint8_t rgb[3])
{
    static const double grey[3] = {0.5, 0.5, 0.5};
    const double *color = fluid >= 0 && (size_t)fluid < colors->count ? colors->color[fluid] : grey;
    for (int k = 0; k < 3; k++)
        rgb[k] = (uint8_t)lround(255 * fmin(fmax(color[k], 0), 1));
}

PointPainter point_painter(const PointColors *colors)
{
    PointPainter painter = {.colors = colors};
    colormap_fill(map_of(colors), painter.map);
    return painter;
}

void point_paint(const PointPainter *painter, const SnapshotStep *step, size_t i, uint8_t rgb[3])
{
    const PointColors *colors = painter->colors;
    if (!colors->mapped) {
        fluid_color(colors, step->fluid[i], rgb);
        return;
    }
    const double above = point_scalar(step, i, colors->scalar) - colors->low;
    const double at = fmin(fmax(above / fmax(colors->high - colors->low, 1e-30), 0), 1);
    memcpy(rgb, painter->map + 3 * lround((COLORMAP_SIZE - 1) * at), 3);
}
