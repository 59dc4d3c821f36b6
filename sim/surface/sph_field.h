/* The particles' field itself, summed over the neighbours of each position: F(r) = sum V_j W_poly6(|r -
   r_j|, h), and a carried scalar, sum V s W / sum V W. Equal to field_at of sim/mesh/field.h, which sums
   over all particles. */
#ifndef SLOSH_SURFACE_SPH_FIELD_H
#define SLOSH_SURFACE_SPH_FIELD_H

#include "sim/base/error.h"
#include "sim/mesh/field.h"
#include "sim/surface/level_field.h"

typedef struct SphField SphField; /* the particles, sorted by cell */

/* Copies the particles, without particles whose position, volume or scalar is not finite. Returns NULL if
   none is left, h is not above 0, or memory is short. */
SphField *sph_field_create(const FieldParticles *particles, Error *error);

void sph_field_destroy(SphField *field); /* NULL is allowed */

/* F: about 1 inside, 0.5 at the surface, 0 farther than h from any particle. `from` must outlive the fields.
 */
LevelField level_sph(const SphField *from);

/* The scalar, without a gradient for F below 0.5: walks on its levels stay inside the fluid. */
LevelField level_sph_inside(const SphField *from);

/* The scalar; 0 without a particle within h. The particles must have a scalar. */
LevelField level_sph_scalar(const SphField *from);

#endif
