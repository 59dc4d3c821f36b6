/* Shapes of the particles in the view splat, if not spheres of the view's radius. Ellipsoid: from the
   covariance of the neighbours, after Yu and Turk, Reconstructing surfaces of particle-based fluids using
   anisotropic kernels, 2013. Drop: a particle with few neighbours shrinks to a ball of its own volume,
   spacing^3. Both change smoothly with the neighbours' weights, so that nothing pops. Ellipsoids beside a
   wall of the box have mirror images as neighbours: a level surface is as flat at the wall as elsewhere.

   The drop's volume is not the solver's 1 / n, which is several times too large without neighbours. */
#ifndef SLOSH_ELLIPSOIDS_H
#define SLOSH_ELLIPSOIDS_H

#include "render/frame/frame.h"
#include "render/particles/neighbourhood.h"
#include "render/splat/splat_def.h"

typedef struct Ellipsoids {
    SplatDef def;
    Neighbourhood neighbourhood; /* if ellipsoids_wanted */
    unsigned program;            /* if ellipsoids_crowded */
    unsigned scale;              /* program for sizes by a scalar, else 0 */
    unsigned shapes; /* buffer, see shaders/common/ball.glsl: three vec4 per particle, or one float if only
                        drops */
    size_t capacity;
} Ellipsoids;

/* Defines for shaders that include common/ball.glsl; at most 60 characters. */
const char *ellipsoids_defines(const SplatDef *def);

/* Factor of the view's radius for sizes by a scalar: the result is the largest radius, an upper bound of
   all. 1 without sizes. */
double ellipsoids_unit(const ViewDef *def, const ParticleBuffers *particles);

/* The longest axis of an ellipsoid, in radii of the view: of axes 5 : 1 : 1. */
#define ELLIPSOID_REACH 2.95

/* Returns false if a shader does not compile; call ellipsoids_destroy in either case. */
bool ellipsoids_create(Ellipsoids *ellipsoids, const SplatDef *def, Error *error);
void ellipsoids_destroy(Ellipsoids *ellipsoids);

/* Makes the ellipsoids from the particles' positions; does nothing if the view has no ellipsoids. */
void ellipsoids_make(Ellipsoids *ellipsoids, const ParticleBuffers *particles, const Frame *frame);

/* Binds the shapes for shaders with common/ball.glsl; does nothing if the view has no ellipsoids. */
void ellipsoids_bind(const Ellipsoids *ellipsoids);

#endif
