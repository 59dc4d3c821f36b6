/* The kernels by which the view slice sums: those of solvers and some more, in two and three dimensions. */
#ifndef SLOSH_PLANE_KERNEL_H
#define SLOSH_PLANE_KERNEL_H

#include "sim/matter/world_def.h"

typedef struct PlaneKernel {
    const char *name, *help;
    double (*shape)(double q); /* of q = r / h, 0 <= q < 1; W = norm shape / h^dimensions */
    double norm[2];            /* in two and in three dimensions */
} PlaneKernel;

/* The first is "solver", without a shape: see plane_kernel_of. Ended by a NULL name. */
extern const PlaneKernel plane_kernels[];

/* The index of the kernel asked for: of "solver" (0) that of the def's method, or the cubic spline where
   there is none. At least 1; shaders know kernels by this number. */
int plane_kernel_of(int asked, const WorldDef *world);

/* By a name as solvers have it; 1, the cubic spline, for one that is not known. */
int plane_kernel_named(const char *name);

/* W(r), 1/m3 or in two dimensions 1/m2; 0 for r >= h. */
double plane_kernel_value(int kernel, int dimensions, double r, double h);

#endif
