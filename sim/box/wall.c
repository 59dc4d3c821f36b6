#include "sim/box/wall.h"

#include <string.h>

void walls_place(Walls *walls, int dimensions, const double box_size[3], const bool open[3], double spacing)
{
    memset(walls, 0, sizeof *walls);
    walls->dimensions = dimensions;
    walls->spacing = (float)spacing;
    for (int k = 0; k < 3; k++) {
        walls->half_size[k] = (float)(0.5 * box_size[k]);
        walls->open[k] = open[k];
    }
}

bool walls_contain(const Walls *walls, const float x[3])
{
    for (int a = 0; a < walls->dimensions; a++) {
        const float low = a == 1 ? 0 : -walls->half_size[a];
        if (!(x[a] >= low && x[a] <= low + 2 * walls->half_size[a]))
            return false;
    }
    return true;
}

bool walls_guard(const Walls *walls, float x[3], float v[3])
{
    bool held = false;
    for (int a = 0; a < walls->dimensions; a++) {
        const float low = a == 1 ? 0 : -walls->half_size[a];
        const float high = a == 1 ? 2 * walls->half_size[1] : walls->half_size[a];
        if (walls->open[a])
            continue;
        if (x[a] < low) {
            x[a] = low;
            v[a] = fmaxf(v[a], 0);
            held = true;
        } else if (x[a] > high) {
            x[a] = high;
            v[a] = fminf(v[a], 0);
            held = true;
        }
    }
    return held;
}

/* Half of a short way; up to half a spacing for a long way. */
static float folded(const Walls *walls, float way)
{
    const float most = 0.5f * walls->spacing;
    return most * way / (way + 2 * most);
}

bool walls_fold(const Walls *walls, float rate, float x[3], float v[3])
{
    bool held = false;
    for (int a = 0; a < walls->dimensions; a++) {
        const float low = a == 1 ? 0 : -walls->half_size[a];
        const float high = a == 1 ? 2 * walls->half_size[1] : walls->half_size[a];
        const float from = x[a];
        if (walls->open[a] || (from >= low && from <= high))
            continue;
        x[a] = from < low ? fminf(low + folded(walls, low - from), high)
                          : fmaxf(high - folded(walls, from - high), low);
        v[a] += rate * (x[a] - from);
        held = true;
    }
    return held;
}
