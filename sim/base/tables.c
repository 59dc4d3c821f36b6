#include "sim/base/base.h"

#include "sim/def.h"

#include <math.h>
#include <stddef.h>

/* Value at `at` of the lines through `count` points, at least 1, with ascending `x`. */
static double lines_at(const double *x, const double *y, int count, double at)
{
    const int last = count - 1;
    int k = 0;
    while (k < last && x[k + 1] <= at)
        k++;
    if (k == last || at <= x[0])
        return y[k];
    return y[k] + (at - x[k]) / (x[k + 1] - x[k]) * (y[k + 1] - y[k]);
}

const ControlPreset control_presets[] = {{"rising", {2, {0, 1}, {0, 1}}},
                                         {"falling", {2, {0, 1}, {1, 0}}},
                                         {"middle", {3, {0, 0.5, 1}, {0, 1, 0}}},
                                         {"ends", {3, {0, 0.5, 1}, {1, 0, 1}}},
                                         {"upper", {4, {0, 0.45, 0.55, 1}, {0, 0, 1, 1}}},
                                         {"even", {1, {0}, {1}}},
                                         {NULL, {0}}};

ControlPoints control_points_straight(void)
{
    return control_presets[0].points;
}

bool control_points_are_straight(const ControlPoints *points)
{
    return control_points_equal(points, &control_presets[0].points);
}

bool control_points_equal(const ControlPoints *a, const ControlPoints *b)
{
    bool equal = a->count == b->count;
    for (int k = 0; k < a->count && equal; k++)
        equal = a->x[k] == b->x[k] && a->y[k] == b->y[k];
    return equal;
}

double control_points_at(const ControlPoints *points, double x)
{
    return lines_at(points->x, points->y, points->count, isnan(x) ? 1 : x);
}

double control_points_most(const ControlPoints *points)
{
    double most = points->y[0];
    for (int k = 1; k < points->count; k++)
        most = fmax(most, points->y[k]);
    return most;
}

double control_points_least(const ControlPoints *points)
{
    double least = points->y[0];
    for (int k = 1; k < points->count; k++)
        least = fmin(least, points->y[k]);
    return least;
}

void control_points_move(ControlPoints *points, int at, double x, double y)
{
    const double low = at > 0 ? points->x[at - 1] + CONTROL_POINTS_GAP : 0;
    const double high = at + 1 < points->count ? points->x[at + 1] - CONTROL_POINTS_GAP : 1;
    if (low <= high)
        points->x[at] = fmin(fmax(x, low), high);
    points->y[at] = y;
}

int control_points_add(ControlPoints *points, double x, double y)
{
    int at = 0;
    if (points->count >= CONTROL_POINTS_MAX || !(x >= 0 && x <= 1))
        return -1;
    for (int k = 0; k < points->count; k++) {
        if (fabs(points->x[k] - x) < CONTROL_POINTS_GAP)
            return -1;
        at += points->x[k] < x;
    }
    for (int k = points->count++; k > at; k--) {
        points->x[k] = points->x[k - 1];
        points->y[k] = points->y[k - 1];
    }
    points->x[at] = x;
    points->y[at] = y;
    return at;
}

bool control_points_remove(ControlPoints *points, int at)
{
    if (points->count < 2)
        return false;
    points->count--;
    for (int k = at; k < points->count; k++) {
        points->x[k] = points->x[k + 1];
        points->y[k] = points->y[k + 1];
    }
    return true;
}

double time_table_at(const TimeTable *table, double time)
{
    return lines_at(table->time, table->value, (int)table->rows, time);
}

/* Slope of a smooth curve at a row. */
static double slope_at(const TimeTable *table, int k)
{
    return k > 0 && k + 1 < (int)table->rows
               ? (table->value[k + 1] - table->value[k - 1]) / (table->time[k + 1] - table->time[k - 1])
               : 0;
}

/* Hermite's cubics, with the slopes of E. Catmull and R. Rom, "A class of local interpolating splines", 1974.
 */
double time_table_smooth(const TimeTable *table, double time, double *rate)
{
    const int last = (int)table->rows - 1;
    int k = 0;
    while (k < last && table->time[k + 1] <= time)
        k++;
    *rate = 0;
    if (k == last || time <= table->time[0])
        return table->value[k];
    const double span = table->time[k + 1] - table->time[k], u = (time - table->time[k]) / span;
    const double rise = table->value[k + 1] - table->value[k];
    const double from = span * slope_at(table, k), to = span * slope_at(table, k + 1);
    const double square = 3 * rise - 2 * from - to, cube = from + to - 2 * rise;
    *rate = (from + u * (2 * square + u * 3 * cube)) / span;
    return table->value[k] + u * (from + u * (square + u * cube));
}

double time_table_most(const TimeTable *table)
{
    double most = 0;
    for (int k = 0; k < (int)table->rows; k++)
        most = fmax(most, table->value[k]);
    return most;
}

double time_table_least(const TimeTable *table)
{
    double least = table->rows > 0 ? INFINITY : 0;
    for (int k = 0; k < (int)table->rows; k++)
        least = fmin(least, table->value[k]);
    return least;
}

bool time_table_sound(const TimeTable *table)
{
    const double rows = table->rows;
    if (!(rows >= 0 && rows <= TIME_TABLE_ROWS && rows == floor(rows)))
        return false;
    for (int k = 0; k < (int)rows; k++)
        if (!(table->value[k] >= 0) || !isfinite(table->value[k]) || !isfinite(table->time[k]) ||
            (k > 0 && !(table->time[k] > table->time[k - 1])))
            return false;
    return true;
}

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
