/* A series of points (x, y), made by metrics and drawn by charts. */
#ifndef SLOSH_CURVE_H
#define SLOSH_CURVE_H

#include <stddef.h>

/* Zero-initialise before use. */
typedef struct Curve {
    size_t count, capacity;
    double (*at)[2]; /* x, y */
} Curve;

/* Adds a point. Ends the program if memory is short: a curve has a few thousand points at most. */
void curve_add(Curve *curve, double x, double y);
void curve_free(Curve *curve);

/* Returns y at x by linear interpolation; x must ascend. NaN outside the points. */
double curve_at(const Curve *curve, double x);

/* Returns the slope of the least-squares line; NaN for less than two points. */
double curve_slope(const Curve *curve);

/* Returns the period of y: the mean distance in x between every second zero crossing, by linear
   interpolation. NaN for less than three crossings. */
double curve_period(const Curve *curve);

/* Finds the peaks of |y|, one between each two zero crossings: x and the natural logarithm of the height,
   by a parabola through the highest point and its neighbours. Omits peaks before the first and after the
   last crossing. */
void curve_log_peaks(const Curve *curve, Curve *peaks);

#endif
