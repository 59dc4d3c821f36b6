/* Greatest share of a solid among a particle's neighbours, for fluid between two solids: see
   sim/methods/shared/incompressible.h. */
#ifndef SLOSH_SHARE_MOST_H
#define SLOSH_SHARE_MOST_H

#define SHARE_MOST 0.5F

#endif
