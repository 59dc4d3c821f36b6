/* Smoothing kernels after Müller, Charypar, Gross, "Particle-based fluid simulation for interactive
   applications", 2003: 3D, support radius h, unit integral; r >= 0 in m; values in 1/m3, zero for r >= h. */
#ifndef SIM_KERNEL_KERNEL_H
#define SIM_KERNEL_KERNEL_H

#include <stdbool.h>

double kernel_poly6(double r, double h);               /* eq. 20 */
double kernel_spiky_derivative(double r, double h);    /* dW/dr <= 0, 1/m4 */
double kernel_viscosity_laplacian(double r, double h); /* >= 0, 1/m5 */

/* A kernel that can sum up density. */
typedef struct Kernel {
    const char *name, *help;
    double (*value)(double r, double h);
    double (*derivative)(double r, double h);
    double stiffness; /* waves of a summed density on the lattice over spiky's: a calm step is shorter by the
                         ratio; 1 with carried density */
} Kernel;

extern const Kernel density_kernels[]; /* spiky and poly6, ended by a NULL name */

/* The kernels of solver.kernel, in the order of ShapeKernel, with q = r / h and the whole support radius h
   (papers use h / 2 or h / 3). */
extern const Kernel shape_kernels[]; /* ended by a NULL name */
typedef enum ShapeKernel { KERNEL_CUBIC, KERNEL_WENDLAND_C2, KERNEL_QUINTIC, SHAPE_KERNELS } ShapeKernel;

/* NULL if no kernel has the name. */
const Kernel *shape_kernel_find(const char *name);
const Kernel *density_kernel_find(const char *name);

/* Kernel sums on an infinite cubic lattice at rest, and factors to correct these sums.

   A kernel that integrates to 1 does not sum to 1 over particles. The density kernel is scaled so that the
   lattice has exactly one particle per volume spacing^3, and with the mass rho0 spacing^3 exactly the rest
   density. Pressure gradient, viscous Laplacian and stiffness are scaled to be exact on the lattice for
   linear pressure, quadratic velocity and uniform compression. Without scaling, pressure in a column at
   support 2.1 would be 4 % too high and sound 10 % too slow. */

typedef struct Lattice {
    int dimensions;        /* 3, or 2: a square lattice; then all 1/m3 are 1/m2 */
    double number_density; /* n0 = 1 / spacing^dimensions; mass = rho0 / n0, in 2D for a depth of a metre */
    double density_scale;  /* factor on the density kernel: n0 over its sum, with the particle itself */
    double gradient_scale; /* factor on the derivative of the pressure kernel */
    const Kernel *pressure_kernel;
    double laplacian_scale; /* factor on the Laplacian of the viscosity kernel */
    /* R, 1/m2, in the radial form of friction (sim/def/fluids.h). With sum V F x^2 = 1 the force is
       mu (laplacian v + 2 grad div v) if R sum V F x^2 y^2 = 1; over all directions R = d (d + 2) / sum V F
       r^4, F = -W' / r */
    double radial_scale;
    double stiffness_scale; /* relative change of volume over relative change of n / n0 */
    int neighbours;         /* neighbours with r < h */
} Lattice;

/* Calibrates for a lattice with the given spacing and support radius, m. */
void lattice_calibrate(int dimensions, double spacing, double support_radius, const Kernel *density_kernel,
                       const Kernel *pressure_kernel, Lattice *lattice);

/* The stiffest sound wave on the lattice at rest: bounds the step of explicit schemes with sound.

   A small displacement u exp(i k x) of all particles changes each density by the density kernel's sum along
   the wave. The resulting pressure pushes by the pressure kernel's sum. With
     D(k) = s sum W'(r) / r x sin(k x), P(k) = V g sum W'(r) / r x sin(k x)
   over the neighbours x of a site, the equation of motion is u'' = -c^2 P (D u). The only moving wave has
   omega^2 = c^2 P D, which is (c k)^2 for long waves. The wave is longitudinal along D; shears have no
   force.

   A leapfrog or Verlet step, with a single evaluation of each force, is stable up to 2 / omega. */

/* For tests: omega / c of the wave with vector k, 1/m, along the axes of a calibrated lattice; 0 without a
   force. `carried`: density follows the continuity equation, with the pressure kernel; otherwise density is
   summed. */
double sound_wave(const Lattice *lattice, double spacing, double support_radius, const Kernel *density_kernel,
                  bool carried, const double k[3]);

/* The maximum over all waves, 1/m. Takes some milliseconds. */
double sound_stiffest(const Lattice *lattice, double spacing, double support_radius,
                      const Kernel *density_kernel, bool carried);

#endif
