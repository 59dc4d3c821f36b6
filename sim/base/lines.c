#include "sim/base/lines.h"

double lines_at(const double *x, const double *y, int count, double at)
{
    const int last = count - 1;
    int k = 0;
    while (k < last && x[k + 1] <= at)
        k++;
    if (k == last || at <= x[0])
        return y[k];
    return y[k] + (at - x[k]) / (x[k + 1] - x[k]) * (y[k + 1] - y[k]);
}
