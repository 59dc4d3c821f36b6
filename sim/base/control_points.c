#include "sim/base/control_points.h"

#include "sim/base/lines.h"

#include <math.h>
#include <stddef.h>

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
