/* View "splat": the fluid as one smooth surface, directly from positions and radii. After: Adams,
   Lenaerts, Dutré, Particle splatting: interactive rendering of particle-based simulation data, CW 453,
   2006. */
#ifndef SLOSH_SPLAT_H
#define SLOSH_SPLAT_H

#include "render/splat/ellipsoids.h"
#include "render/splat/splat_def.h"
#include "render/splat/splat_maps.h"

/* Maps of a state made by view_splat.create; for tests. */
const SplatMaps *splat_maps(const void *state);
const Ellipsoids *splat_ellipsoids(const void *state);
unsigned splat_thickness_map(const void *state); /* see render/splat/thickness.h; 0 if the shading needs no
                                                    thickness */

/* The maps that shaded the last picture: with a filter, the filtered depth and normals. */
const SplatMaps *splat_shown_maps(const void *state);

#endif
