/* Smooths the outlines of the view splat in a finished picture: edges of the fluid before the background,
   a solid, or fluid farther behind. Writes only pixels beside such edges.

   By discs: samples in a pixel are tested against the discs of the foremost spheres around; pass 2 stores
   the discs' positions in the alphas of its maps. Exact, except for spheres that fall between samples. By
   rows, for surfaces that are not spheres: the ends of each row of edge pixel sides show the slope of the
   true outline. The outline is taken as straight from half a pixel beside an end to the row's middle. A
   pixel then gives the part beyond the outline to the neighbour across the edge. After: Reshetov,
   Morphological antialiasing, HPG 2009, and Jimenez et al., SMAA: enhanced subpixel morphological
   antialiasing, CGF 31 (2), 2012. */
#ifndef SLOSH_SILHOUETTE_H
#define SLOSH_SILHOUETTE_H

#include "render/frame/frame.h"
#include "render/splat/fluid_tiles.h"
#include "render/splat/splat_maps.h"
#include "sim/base/error.h"

enum { SILHOUETTE_PASSES = 3 };

typedef struct Silhouette {
    unsigned programs[SILHOUETTE_PASSES]; /* find pixels; find their edges; mix colours */
    unsigned target_number;
    unsigned near;    /* DEPTH_COMPONENT16: pixels that may have an outline */
    unsigned edges;   /* RGBA8: the pixel sides that are edges; silhouette_edges.frag */
    unsigned picture; /* copy of the target's colour */
    unsigned edges_framebuffer, target_framebuffer;
    unsigned target; /* the target's colour as RGBA8, without sRGB conversion */
} Silhouette;

/* Returns false if a shader does not compile; call silhouette_destroy in either case. */
bool silhouette_create(Silhouette *silhouette, const Subject *subject, Error *error);
void silhouette_destroy(Silhouette *silhouette); /* a zeroed struct is allowed */

/* Changes the target's colour. `blended`: the maps after pass 2; `nearest`: the depth map used for
   shading. Fluid more than `step` (m) farther behind than its slope explains is behind an edge. */
void silhouette_draw(Silhouette *silhouette, const SplatMaps *blended, unsigned nearest, float step,
                     const FluidTiles *tiles, const Frame *frame);

#endif
