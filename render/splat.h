/* View "splat": the fluid as one smooth surface, straight from positions and radii. After: Adams, Lenaerts,
   Dutré, Particle splatting: interactive rendering of particle-based simulation data, CW 453, 2006. */
#ifndef SLOSH_SPLAT_H
#define SLOSH_SPLAT_H

#include "render/splat_names.h"
#include "render/view.h"

extern const ViewKind view_splat;

/* What the passes leave for the next: textures as large as the target. */
typedef struct SplatMaps {
    unsigned target_number; /* of the target that they were made for */
    unsigned nearest;       /* R32F: least depth of a sphere along the eye's axis, m; 1e30 where none is */
    unsigned
        color; /* RGBA16F, on a software driver the faster RGBA32F: sum of weight x linear colour (eq. 8) */
    unsigned normal; /* the same: sum of weight x normal in the eye's frame (eq. 9) */
    unsigned weight; /* R32F: sum of weights (eq. 10) */
    unsigned limit;  /* DEPTH_COMPONENT32F: the depth at which blending ends */
    unsigned nearest_framebuffer, blend_framebuffer;
} SplatMaps;

/* Of a state that view_splat.create made; for tests. */
const SplatMaps *splat_maps(const void *state);

#endif
