/* How far light goes through still water in a tank. */
#ifndef SLOSH_STILL_WATER_H
#define SLOSH_STILL_WATER_H

#include <math.h>
#include <string.h>

/* The path in still water between two corners, m, seen along a direction (unit) from a place on the top
   or a side. Bent by Snell's law, and mirrored by sides met at less than arcsin(1 / 1.333) to the side's
   plane. `sides`: number of reflections. */
static inline double way_in_water(const double low[3], const double high[3], const double entry[3],
                                  const double to[3], int *sides)
{
    const double ior = 1.333;
    double at[3], way[3], square = 0, total = 0;
    int in = 1;
    memcpy(at, entry, sizeof at);
    for (int k = 0; k < 3; k++)
        in = fmin(at[k] - low[k], high[k] - at[k]) < fmin(at[in] - low[in], high[in] - at[in]) ? k : in;
    for (int k = 0; k < 3; k++)
        square += k == in ? 0 : to[k] * to[k] / (ior * ior), way[k] = to[k] / ior;
    way[in] = copysign(sqrt(1 - square), to[in]);
    for (*sides = 0;; (*sides)++) {
        int out = 0;
        double t = INFINITY;
        for (int k = 0; k < 3; k++) {
            const double end = ((way[k] > 0 ? high[k] : low[k]) - at[k]) / way[k];
            if (end < t)
                t = end, out = k;
        }
        total += t;
        for (int k = 0; k < 3; k++)
            at[k] += t * way[k];
        if (out == 1 || fabs(way[out]) > 1 / ior)
            return total;
        way[out] = -way[out];
    }
}

#endif
