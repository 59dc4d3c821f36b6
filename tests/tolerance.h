/* Comparison of numbers with a tolerance. */
#ifndef SLOSH_TESTS_TOLERANCE_H
#define SLOSH_TESTS_TOLERANCE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

static inline void check_near(double is, double should, double tolerance, const char *what)
{
    if (!(fabs(is - should) <= tolerance))
        fail_msg("%s is %.12g, not %.12g (to %g)", what, is, should, tolerance);
}

static inline void check_vector(const double is[3], double x, double y, double z, double tolerance,
                                const char *what)
{
    const double should[3] = {x, y, z};
    for (int k = 0; k < 3; k++)
        if (!(fabs(is[k] - should[k]) <= tolerance))
            fail_msg("%s is [%.9g, %.9g, %.9g], not [%.9g, %.9g, %.9g] (to %g)", what, is[0], is[1], is[2], x,
                     y, z, tolerance);
}

#endif
