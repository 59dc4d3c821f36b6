/* Bound of the boundary part over n0: sim/methods/shared/incompressible.h. What boundary particles add to n
   is off by some 3 % as it is. With 0.02 a disc starts to sink too slowly, with 0.005 water stirs itself
   after a fall. */
#ifndef SLOSH_BOUNDARY_MOST_H
#define SLOSH_BOUNDARY_MOST_H

#define BOUNDARY_MOST 0.01F

#endif
