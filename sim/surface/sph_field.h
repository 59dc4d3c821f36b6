/* The particles' field itself, summed over the neighbours of each place: F(r) = sum V_j W_poly6(|r - r_j|,
   h), and a scalar that particles carry, sum V s W / sum V W. The same as field_at of sim/mesh/field.h, which
   sums over all. */
#ifndef SLOSH_SURFACE_SPH_FIELD_H
#define SLOSH_SURFACE_SPH_FIELD_H

#include "sim/base/error.h"
#include "sim/mesh/field.h"
#include "sim/surface/level_field.h"

typedef struct SphField SphField; /* the particles, sorted by cell */

/* Copies the particles. One whose position, volume or scalar is not finite is left out. NULL when there is
   none left, h is not above 0, or memory is short. */
SphField *sph_field_create(const FieldParticles *particles, Error *error);

void sph_field_destroy(SphField *field); /* NULL is allowed */

/* F: about 1 inside, 0.5 at the surface, 0 farther than h from any particle. `from` must outlive the fields.
 */
LevelField level_sph(const SphField *from);

/* The scalar, without a gradient where F is less than 0.5: walks on its levels stay inside the fluid. */
LevelField level_sph_inside(const SphField *from);

/* The scalar; 0 where no particle is within h. Of particles that have one. */
LevelField level_sph_scalar(const SphField *from);

#endif
