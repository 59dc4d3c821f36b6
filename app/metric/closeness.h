/* Closeness of particles: counts of particles too near to a neighbour (pairs and clumps); coherence of
   motion. */
#ifndef SLOSH_CLOSENESS_H
#define SLOSH_CLOSENESS_H

#include "app/metric/cloud.h"

/* Counts, among every `stride`-th particle, particles with a neighbour of any fluid nearer than `limit`
   (m, more than 0). Neighbours are searched among all particles. Pairs across periodic sides are ignored;
   positions with NaN or infinity are skipped. Returns false if memory is short. */
bool metric_close(const Cloud *cloud, double limit, size_t stride, size_t *close);

/* Fraction of the kinetic energy of every `stride`-th particle in common motion with neighbours nearer
   than h: sum v . u over sum v . v, with u the weighted mean velocity of the neighbours. 1 without motion
   or in uniform motion; 0 for a gas. Returns false if memory is short. */
bool metric_together(const Cloud *cloud, double h, size_t stride, double *together);

#endif
