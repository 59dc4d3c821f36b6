/* Kernels for the sums of the view slice: the solvers' kernels and some more, in two and three dimensions. */
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

/* The kernel's index: for `asked` "solver" (0) the kernel of the world's method, or the cubic spline
   without a method. At least 1; shaders use the same numbers. */
int plane_kernel_of(int asked, const WorldDef *world);

/* The kernel's index by the solvers' name; 1, the cubic spline, for unknown names. */
int plane_kernel_named(const char *name);

/* W(r), 1/m3, or in two dimensions 1/m2; 0 for r >= h. */
double plane_kernel_value(int kernel, int dimensions, double r, double h);

#endif
