#include "sim/base/field_table.h"

#include <math.h>

/* The plane at or below x, and the position of x between the plane and the next, 0 to 1. */
static int plane_below(const FieldTable *table, int axis, double x, double *way)
{
    const double *place = table->place[axis];
    int low = 0, high = table->count[axis] - 1;
    *way = 0;
    if (high == 0)
        return 0;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (place[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    *way = fmin(fmax((x - place[low]) / (place[high] - place[low]), 0), 1);
    return low;
}

double field_table_at(const FieldTable *table, int column, const double x[3])
{
    int low[3];
    double way[3], sum = 0;
    for (int k = 0; k < 3; k++)
        low[k] = plane_below(table, k, x[k], &way[k]);
    for (int corner = 0; corner < 8; corner++) {
        double part = 1;
        int at[3];
        for (int k = 0; k < 3; k++) {
            const int high = corner >> k & 1;
            part *= high ? way[k] : 1 - way[k];
            at[k] = low[k] + high;
        }
        if (part > 0)
            sum += part *
                   table->value[column][at[0] + table->count[0] * (at[1] + (long)table->count[1] * at[2])];
    }
    return sum;
}
