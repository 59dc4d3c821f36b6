/* Lines between points, constant outside. */
#ifndef SLOSH_LINES_H
#define SLOSH_LINES_H

/* Value at `at` of the lines through `count` points, at least 1, with ascending `x`. */
double lines_at(const double *x, const double *y, int count, double at);

#endif
