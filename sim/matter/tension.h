/* Surface tension, for scenes that name it: two models, each a sum over pairs of its own. */
#ifndef SLOSH_TENSION_H
#define SLOSH_TENSION_H

#include "sim/matter/world_def.h"

typedef enum TensionModel { TENSION_NONE, TENSION_COLOUR_FIELD, TENSION_COHESION } TensionModel;

typedef struct TensionKind {
    const char *name, *help;
} TensionKind;

extern const TensionKind tension_kinds[]; /* in the order of TensionModel, ended by a NULL name */

/* Akinci, Akinci, Teschner 2013, eq. 2, without its factor 32 / (pi h^9): positive attracts; zero for
   r >= h. m6 for r and h in m. */
double cohesion_kernel(double r, double h);

/* The factor g in the force -g V_i V_j C(r) (x_ij / r) that makes the tension of a flat surface 1 N/m: half
   the work, an area, that it takes to part the lattice at rest along a plane of it. */
double cohesion_scale(int dimensions, double spacing, double h);

/* poly6's factor in the colour field's gradient and Laplacian (Müller 2003, eq. 15 to 19): 945 / (32 pi h^9),
   in two dimensions 24 / (pi h^8). */
double colour_scale(int dimensions, double h);

#endif
