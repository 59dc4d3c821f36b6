/* Straight lines between points, constant before the first and after the last. */
#ifndef SLOSH_LINES_H
#define SLOSH_LINES_H

/* The value at `at` of the lines through `count` points, 1 and more, whose places `x` ascend. */
double lines_at(const double *x, const double *y, int count, double at);

#endif
