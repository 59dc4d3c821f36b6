/* A row of points (x, y), as metrics make and charts draw it. */
#ifndef SLOSH_CURVE_H
#define SLOSH_CURVE_H

#include <stddef.h>

/* Zero-initialise it. */
typedef struct Curve {
    size_t count, capacity;
    double (*at)[2]; /* x, y */
} Curve;

/* Ends the program where memory is short: a curve has some thousand points at most. */
void curve_add(Curve *curve, double x, double y);
void curve_free(Curve *curve);

/* y at x, on straight lines between the points, whose x ascends; NaN outside of them. */
double curve_at(const Curve *curve, double x);

/* The slope of the least-squares line; NaN with less than two points. */
double curve_slope(const Curve *curve);

/* Where y passes 0, by straight lines between the points: the mean way in x from one passing to the next but
   one. NaN with less than three passings. */
double curve_period(const Curve *curve);

/* The peaks of |y|, one between each two passings of 0: x and the natural logarithm of the
   height, by a parabola through the highest point and its neighbours. The last one, which may be cut, is
   left out, and so is that before the first passing. */
void curve_log_peaks(const Curve *curve, Curve *peaks);

#endif
