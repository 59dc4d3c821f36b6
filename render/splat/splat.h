/* View "splat": the fluid as one smooth surface, straight from positions and radii. After: Adams, Lenaerts,
   Dutré, Particle splatting: interactive rendering of particle-based simulation data, CW 453, 2006. */
#ifndef SLOSH_SPLAT_H
#define SLOSH_SPLAT_H

#include "render/splat/ellipsoids.h"
#include "render/splat/splat_def.h"
#include "render/splat/splat_maps.h"

/* Of a state that view_splat.create made; for tests. */
const SplatMaps *splat_maps(const void *state);
const Ellipsoids *splat_ellipsoids(const void *state);
unsigned
splat_thickness_map(const void *state); /* see render/splat/thickness.h; 0 where the shading wants none */

/* The maps that the last picture was shaded from: with a filter its depth and normals. */
const SplatMaps *splat_shown_maps(const void *state);

#endif
