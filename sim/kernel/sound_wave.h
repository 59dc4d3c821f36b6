/* The stiffest sound wave on the lattice at rest: bounds the step of explicit schemes with sound.

   A small displacement u exp(i k x) of all particles changes each density by the density kernel's sum along
   the wave. The resulting pressure pushes by the pressure kernel's sum. With
     D(k) = s sum W'(r) / r x sin(k x), P(k) = V g sum W'(r) / r x sin(k x)
   over the neighbours x of a site, the equation of motion is u'' = -c^2 P (D u). The only moving wave has
   omega^2 = c^2 P D, which is (c k)^2 for long waves. The wave is longitudinal along D; shears have no
   force.

   A leapfrog or Verlet step, with a single evaluation of each force, is stable up to 2 / omega. */
#ifndef SLOSH_SOUND_WAVE_H
#define SLOSH_SOUND_WAVE_H

#include "sim/kernel/lattice.h"

#include <stdbool.h>

/* omega / c of the wave with vector k, 1/m, along the axes of a calibrated lattice; 0 without a force.
   `carried`: density follows the continuity equation, with the pressure kernel; otherwise density is
   summed. */
double sound_wave(const Lattice *lattice, double spacing, double support_radius, const Kernel *density_kernel,
                  bool carried, const double k[3]);

/* The maximum over all waves, 1/m. Takes some milliseconds. */
double sound_stiffest(const Lattice *lattice, double spacing, double support_radius,
                      const Kernel *density_kernel, bool carried);

#endif
