/* Smoothing kernels after Müller, Charypar, Gross, "Particle-based fluid simulation for interactive
   applications", 2003: 3D, support radius h, unit integral; r >= 0 in m; values in 1/m3, zero for r >= h. */
#ifndef SLOSH_KERNEL_H
#define SLOSH_KERNEL_H

double kernel_poly6(double r, double h);               /* eq. 20 */
double kernel_poly6_derivative(double r, double h);    /* dW/dr <= 0, 1/m4 */
double kernel_spiky(double r, double h);               /* eq. 21 */
double kernel_spiky_derivative(double r, double h);    /* dW/dr <= 0, 1/m4 */
double kernel_viscosity(double r, double h);           /* eq. 22; infinite at r = 0 */
double kernel_viscosity_laplacian(double r, double h); /* >= 0, 1/m5 */

/* Kernel shapes of solver.kernel, with q = r / h and the whole support radius h (papers use h / 2 or h /
   3). */
double kernel_cubic(double r, double h); /* cubic spline: Monaghan and Lattanzio 1985 */
double kernel_cubic_derivative(double r, double h);
double kernel_wendland_c2(double r, double h); /* Wendland 1995; Dehnen and Aly 2012 */
double kernel_wendland_c2_derivative(double r, double h);
double kernel_quintic(double r, double h); /* quintic spline: Morris 1996 */
double kernel_quintic_derivative(double r, double h);

/* A kernel that can sum up density. */
typedef struct Kernel {
    const char *name, *help;
    double (*value)(double r, double h);
    double (*derivative)(double r, double h);
} Kernel;

extern const Kernel density_kernels[]; /* ended by a NULL name */

/* The kernels of solver.kernel, in the order of ShapeKernel. */
extern const Kernel shape_kernels[]; /* ended by a NULL name */
typedef enum ShapeKernel { KERNEL_CUBIC, KERNEL_WENDLAND_C2, KERNEL_QUINTIC, SHAPE_KERNELS } ShapeKernel;

/* NULL if no kernel has the name. */
const Kernel *shape_kernel_find(const char *name);
const Kernel *density_kernel_find(const char *name);

#endif
