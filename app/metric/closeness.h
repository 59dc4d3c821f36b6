/* Particles beside others: which are too near, pairs and clumps; and whether they move alike. */
#ifndef SLOSH_CLOSENESS_H
#define SLOSH_CLOSENESS_H

#include "app/metric/cloud.h"

/* How many of every `stride`-th particle, of one fluid or of several, have another one nearer than `limit`
   (m, more than 0), be it one of those or not; pairs across periodic sides are not seen, places that are no
   numbers are left out. False when memory is short. */
bool metric_close(const Cloud *cloud, double limit, size_t stride, size_t *close);

/* How much of the energy of motion of every `stride`-th particle is of motion together with others nearer
   than h: sum v . u over sum v . v, with u the mean velocity of these, nearer ones counting more. 1 where
   nothing moves, or everything alike; 0 of a gas. False when memory is short. */
bool metric_together(const Cloud *cloud, double h, size_t stride, double *together);

#endif
