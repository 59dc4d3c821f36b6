#include "app/metric/curve.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

void curve_add(Curve *curve, double x, double y)
{
    if (curve->count == curve->capacity) {
        const size_t capacity = curve->capacity ? 2 * curve->capacity : 256;
        double(*at)[2] = realloc(curve->at, capacity * sizeof *at);
        if (!at) {
            fputs("slosh: no memory for a curve\n", stderr);
            abort();
        }
        curve->at = at;
        curve->capacity = capacity;
    }
    curve->at[curve->count][0] = x;
    curve->at[curve->count++][1] = y;
}

void curve_free(Curve *curve)
{
    free(curve->at);
    *curve = (Curve){.count = 0};
}

double curve_at(const Curve *curve, double x)
{
    for (size_t i = 1; i < curve->count; i++) {
        const double *a = curve->at[i - 1], *b = curve->at[i];
        if (a[0] <= x && x <= b[0])
            return b[0] > a[0] ? a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]) : a[1];
    }
    return NAN;
}

double curve_slope(const Curve *curve)
{
    const double n = (double)curve->count;
    double mean[2] = {0}, xx = 0, xy = 0;
    for (size_t i = 0; i < curve->count; i++)
        for (int k = 0; k < 2; k++)
            mean[k] += curve->at[i][k] / n;
    for (size_t i = 0; i < curve->count; i++) {
        const double x = curve->at[i][0] - mean[0];
        xx += x * x;
        xy += x * (curve->at[i][1] - mean[1]);
    }
    return xx > 0 ? xy / xx : (double)NAN;
}

/* True if y crosses 0 between points i - 1 and i. */
static bool passes(const Curve *curve, size_t i)
{
    return (curve->at[i - 1][1] < 0) != (curve->at[i][1] < 0);
}

double curve_period(const Curve *curve)
{
    double first = 0, last = 0;
    int passings = 0;
    for (size_t i = 1; i < curve->count; i++) {
        const double *a = curve->at[i - 1], *b = curve->at[i];
        if (!passes(curve, i))
            continue;
        last = a[0] + (a[0] - b[0]) * a[1] / (b[1] - a[1]);
        if (passings++ == 0)
            first = last;
    }
    return passings > 2 ? 2 * (last - first) / (passings - 1) : (double)NAN;
}

/* Adds the top of the parabola through |y| at points i - 1, i and i + 1, evenly spaced. */
static void add_peak(const Curve *curve, size_t i, Curve *peaks)
{
    const double a = fabs(curve->at[i - 1][1]), b = fabs(curve->at[i][1]), c = fabs(curve->at[i + 1][1]),
                 bend = a - 2 * b + c;
    const double shift = bend < 0 ? 0.5 * (a - c) / bend : 0;
    const double step = 0.5 * (curve->at[i + 1][0] - curve->at[i - 1][0]);
    curve_add(peaks, curve->at[i][0] + shift * step, log(b - 0.25 * (a - c) * shift));
}

void curve_log_peaks(const Curve *curve, Curve *peaks)
{
    size_t top = 0;
    for (size_t i = 1; i + 1 < curve->count; i++) {
        if (passes(curve, i)) {
            if (top > 0)
                add_peak(curve, top, peaks);
            top = i;
        } else if (top > 0 && fabs(curve->at[i][1]) > fabs(curve->at[top][1])) {
            top = i;
        }
    }
}
