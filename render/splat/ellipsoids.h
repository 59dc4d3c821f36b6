/* What stands for each particle in the view splat where it is not a sphere of the view's radius: an ellipsoid
   from the covariance of its neighbours, after Yu and Turk, Reconstructing surfaces of particle-based fluids
   using anisotropic kernels, 2013; or, of a particle with few neighbours, a ball on its way to the drop that
   it is: one of its own volume, spacing^3. Both fade with the neighbours' weights, so that nothing pops.
   Ellipsoids beside a wall of the box have images behind it for neighbours: a level is as flat there as
   elsewhere.

   That volume is not the solver's 1 / n: without neighbours to sum up, it is several times as large. */
#ifndef SLOSH_ELLIPSOIDS_H
#define SLOSH_ELLIPSOIDS_H

#include "render/frame/frame.h"
#include "render/particles/neighbourhood.h"
#include "render/splat/splat_def.h"

typedef struct Ellipsoids {
    SplatDef def;
    Neighbourhood neighbourhood; /* where ellipsoids_wanted */
    unsigned program;            /* where ellipsoids_crowded */
    unsigned scale;              /* program, of sizes by a scalar; else 0 */
    unsigned shapes; /* buffer: see shaders/common/ball.glsl; three vec4 a particle, with drops alone a
                        float */
    size_t capacity;
} Ellipsoids;

/* For shaders that include common/ball.glsl; none is longer than 60 characters. */
const char *ellipsoids_defines(const SplatDef *def);

/* What the radius of a view whose sizes go with a scalar is multiplied by: it is then that of the largest,
   and all are within it. 1 without. */
double ellipsoids_unit(const ViewDef *def, const ParticleBuffers *particles);

/* The longest axis of an ellipsoid, in radii of the view: of axes 5 : 1 : 1. */
#define ELLIPSOID_REACH 2.95

/* False when a shader does not compile; ellipsoids_destroy is needed in either case. */
bool ellipsoids_create(Ellipsoids *ellipsoids, const SplatDef *def, Error *error);
void ellipsoids_destroy(Ellipsoids *ellipsoids);

/* Makes the ellipsoids of these particles from their positions; nothing where the view wants no ellipsoids.
 */
void ellipsoids_make(Ellipsoids *ellipsoids, const ParticleBuffers *particles, const Frame *frame);

/* Binds them for shaders that include common/ball.glsl; nothing where the view wants no ellipsoids. */
void ellipsoids_bind(const Ellipsoids *ellipsoids);

#endif
