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
    unsigned settle; /* program: writes the depth before the colour, so that shading runs only on fluid; 0
                        with solids, whose depths would let shading run too */
    unsigned mixing; /* program for spheres smaller than pixels, which show the background; if
                        silhouette_by_discs */
    bool clear;      /* water or jelly: the background shows through */
    Behind behind;   /* if clear */
    Edges edges;     /* if clear: the box's edges, seen through the fluid */
} SplatShade;

/* Returns false if a shader does not compile; call splat_shade_destroy in either case. */
bool splat_shade_create(SplatShade *shade, const Subject *subject, Error *error);
void splat_shade_destroy(SplatShade *shade);

/* Writes the surface's colour and depth. Solids are already in the target: the depth test decides between
   both. `thickness`: for shadings with splat_shade_wants_thickness, else zeroed. */
void splat_shade_draw(SplatShade *shade, const SplatMaps *maps, const Thickness *thickness,
                      const FluidTiles *tiles, const Frame *frame);

#endif
