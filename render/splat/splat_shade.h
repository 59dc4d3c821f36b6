/* Pass 3 of the view splat: deferred shading of the blended surface into the target. After: Adams et al.
   2006, section 3.3. */
#ifndef SLOSH_SPLAT_SHADE_H
#define SLOSH_SPLAT_SHADE_H

#include "render/frame/behind.h"
#include "render/splat/fluid_tiles.h"
#include "render/splat/splat_maps.h"
#include "render/splat/thickness.h"
#include "sim/base/error.h"

typedef struct SplatShade {
    unsigned program;
    unsigned settle; /* program: the depth before the colour, so that shading runs where fluid is; 0 with
                        solids, whose depths would let it run, too */
    unsigned mixing; /* program for spheres smaller than pixels, which let through what is behind; where
                        silhouette_by_discs */
    bool clear;      /* water or jelly: what is behind shows through */
    Behind behind;   /* where clear */
    Edges edges;     /* where clear: of the box, seen through the fluid */
} SplatShade;

/* False when a shader does not compile; splat_shade_destroy is needed in either case. */
bool splat_shade_create(SplatShade *shade, const Subject *subject, Error *error);
void splat_shade_destroy(SplatShade *shade);

/* Writes colour and depth of the surface. Solids are in the target already: the test of depth says who hides
   whom. `thickness`: where the shading reads it (splat_shade_wants_thickness), else of
   zeros. */
void splat_shade_draw(SplatShade *shade, const SplatMaps *maps, const Thickness *thickness,
                      const FluidTiles *tiles, const Frame *frame);

#endif
