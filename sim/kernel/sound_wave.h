/* The stiffest wave of sound on the lattice at rest: it bounds the step of whatever follows sound explicitly.

   A small displacement u exp(i k x) of all particles changes the density of each by what the density's kernel
   has along its wave, and that pressure pushes by what the pressure's kernel has: with
     D(k) = s sum W'(r) / r x sin(k x),  P(k) = V g sum W'(r) / r x sin(k x)
   over the neighbours x of a site the equation of motion is u'' = -c^2 P (D u), so that the one wave that
   moves has omega^2 = c^2 P D, c k where it is long. It is one along D; shears have no force. A leapfrog or
   Verlet step, one evaluation of each force a step, stands 2 / omega. */
#ifndef SLOSH_SOUND_WAVE_H
#define SLOSH_SOUND_WAVE_H

#include "sim/kernel/lattice.h"

#include <stdbool.h>

/* omega / c of the wave of that vector, 1/m, along the axes of a calibrated lattice; 0 where it has no force.
   `carried`: the density follows the continuity equation, by the pressure's kernel; else it is summed. */
double sound_wave(const Lattice *lattice, double spacing, double support_radius, const Kernel *density_kernel,
                  bool carried, const double k[3]);

/* The greatest of all waves, 1/m. Takes some milliseconds. */
double sound_stiffest(const Lattice *lattice, double spacing, double support_radius,
                      const Kernel *density_kernel, bool carried);

#endif
