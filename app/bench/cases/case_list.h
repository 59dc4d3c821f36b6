/* The list of the cases. */
#ifndef APP_BENCH_CASES_CASE_LIST_H
#define APP_BENCH_CASES_CASE_LIST_H

#include "app/bench/cases/case.h"

/* X(name): the cases in the order of their runs; each is a `const Case case_NAME` in a file here. */
#define CASES(X)                                                                                             \
    X(hydrostatic)                                                                                           \
    X(hydrostatic_3d)                                                                                        \
    X(tilted)                                                                                                \
    X(layers)                                                                                                \
    X(layers_10)                                                                                             \
    X(layers_1000)                                                                                           \
    X(growth)                                                                                                \
    X(growth_10)                                                                                             \
    X(dam_break)                                                                                             \
    X(dam_break_2d)                                                                                          \
    X(dam_pressure)                                                                                          \
    X(free_fall)                                                                                             \
    X(bucket)                                                                                                \
    X(sloshing)                                                                                              \
    X(rolling)                                                                                               \
    X(floating)                                                                                              \
    X(heaving)                                                                                               \
    X(wave)                                                                                                  \
    X(ellipse)                                                                                               \
    X(collision)                                                                                             \
    X(drop)                                                                                                  \
    X(laplace)                                                                                               \
    X(contact_angle)                                                                                         \
    X(vortices)                                                                                              \
    X(vortices_1000)                                                                                         \
    X(poiseuille)                                                                                            \
    X(couette)                                                                                               \
    X(cavity)                                                                                                \
    X(cavity_400)                                                                                            \
    X(cavity_1000)

#define X(name) extern const Case case_##name;
CASES(X)
#undef X

#endif
