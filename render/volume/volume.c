#include "render/volume/volume.h"

#include <math.h>
#include <string.h>

enum { SIDE_MAX = 4096, CROP = 8 };
static const double CELLS_MAX = 2147483648.0;

static double longest(const double size[3])
{
    return fmax(size[0], fmax(size[1], size[2]));
}

/* Requested side of a cell, m. */
static double asked_side(const VolumeDef *def, const ParticleBuffers *particles)
{
    const double side = longest(particles->box_size) / def->cells;
    if (def->cell > 0)
        return def->cell * particles->spacing;
    if (def->cells_least > 0)
        return fmin(fmax(side, VOLUME_FINEST * particles->spacing),
                    longest(particles->box_size) / def->cells_least);
    return side;
}

bool volume_grid_for(const VolumeDef *def, const ParticleBuffers *particles, VolumeGrid *grid, Error *error)
{
    const double *box = particles->box_size, margin = particles->support_radius;
    const double asked = asked_side(def, particles);
    const double cell = margin > 0 ? fmin(asked, margin) : asked; /* wider cells could lose fluid between
                                                                     samples */
    double all = 1;
    *grid = (VolumeGrid){.cell = cell};
    for (int k = 0; k < 3; k++) {
        const double cells = ceil((box[k] + 2 * margin) / cell - 1e-6);
        if (!(cells <= SIDE_MAX))
            return error_set(
                error,
                "a volume of %.0f cells along %c; at most %d will do: take fewer view.volume.cells, or "
                "a larger view.volume.cell",
                cells, "xyz"[k], SIDE_MAX);
        grid->size[k] = (int)fmax(cells, 1);
        grid->corner[k] = (k == 1 ? box[k] / 2 : 0) - grid->size[k] * cell / 2;
        all *= grid->size[k];
    }
    return all <= CELLS_MAX ||
           error_set(
               error,
               "a volume of %d x %d x %d cells; at most %.0f of them will do: take fewer view.volume.cells, "
               "or a larger view.volume.cell",
               grid->size[0], grid->size[1], grid->size[2], CELLS_MAX);
}

/* The cell of a position, clamped to the grid. */
static int cell_of(const VolumeGrid *grid, int axis, double at)
{
    const double cell = floor((at - grid->corner[axis]) / grid->cell);
    return (int)fmax(0, fmin(cell, grid->size[axis] - 1)); /* 0 for NaN */
}

void volume_grid_crop(const VolumeGrid *whole, const double low[3], const double high[3], double support,
                      VolumeGrid *out)
{
    *out = *whole;
    for (int k = 0; k < 3; k++) {
        const bool any = low[0] <= high[0];
        const int first = any ? cell_of(whole, k, low[k] - support) / CROP * CROP : 0;
        const int end = any ? (cell_of(whole, k, high[k] + support) / CROP + 1) * CROP : 1;
        out->size[k] = (end < whole->size[k] ? end : whole->size[k]) - first;
        out->corner[k] = whole->corner[k] + first * whole->cell;
    }
}
