#include "app/touch/walls.h"

#include <math.h>
#include <string.h>

static const double ARROW = 0.08; /* of the box's diagonal */

static Handle arrow(const double size[3], int axis, int side)
{
    static const char *const helps[] = {"the box becomes wider or narrower",
                                        "the box becomes higher or lower",
                                        "the box becomes deeper or shallower"};
    const double length = ARROW * sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
    Handle handle = {
        .help = helps[axis], .look = HANDLE_ARROW, .way = HANDLE_ALONG, .from = {0, 0.5 * size[1], 0}};
    handle.from[axis] = axis == 1 ? size[1] : 0.5 * side * size[axis];
    memcpy(handle.at, handle.from, sizeof handle.at);
    handle.at[axis] += side * length;
    handle.axis[axis] = side;
    return handle;
}

int wall_handles(const double size[3], const bool open[3], int dimensions, Handle handles[WALL_HANDLES_MAX])
{
    int count = 0;
    for (int axis = 0; axis < dimensions; axis++)
        for (int side = 1; side >= (axis == 1 ? 1 : -1) && !open[axis]; side -= 2)
            handles[count++] = arrow(size, axis, side);
    return count;
}

void wall_drag(const Handle *taken, const double at[3], double least, double size[3])
{
    int axis = 0;
    while (axis < 2 && taken->axis[axis] == 0)
        axis++;
    const double length = fabs(taken->at[axis] - taken->from[axis]),
                 out = taken->axis[axis] * at[axis] - length;
    size[axis] = fmax(axis == 1 ? out : 2 * out, least);
}
