/* Which particles are too near to another one: pairs and clumps. */
#ifndef SLOSH_CLOSENESS_H
#define SLOSH_CLOSENESS_H

#include "app/metric/cloud.h"

/* How many of every `stride`-th particle, of one fluid or of several, have another one nearer than `limit`
   (m, more than 0), be it one of those or not; pairs across periodic sides are not seen, places that are no
   numbers are left out. False when memory is short. */
bool metric_close(const Cloud *cloud, double limit, size_t stride, size_t *close);

#endif
