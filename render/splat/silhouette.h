/* Smooths the outlines of the view splat in a finished picture: where the fluid ends before the background, a
   solid or fluid farther behind. Only pixels beside such an edge are written.

   By discs: what a pixel's part of the picture shows is sampled against the discs of the foremost spheres
   around, whose places pass 2 keeps in the alphas of its maps; exact but for what slips between. By rows,
   where the surface is not that of the spheres: along each row of pixels' sides that are edges, the ends tell
   how the true outline leans, which is taken as straight from half a pixel beside an end to the row's middle.
   A pixel gives to its neighbour across the edge what of it lies beyond. After: Reshetov, Morphological
   antialiasing, HPG 2009, and Jimenez et al., SMAA: enhanced subpixel morphological antialiasing, CGF 31 (2),
   2012. */
#ifndef SLOSH_SILHOUETTE_H
#define SLOSH_SILHOUETTE_H

#include "render/frame/frame.h"
#include "render/splat/fluid_tiles.h"
#include "render/splat/splat_maps.h"
#include "sim/base/error.h"

enum { SILHOUETTE_PASSES = 3 };

typedef struct Silhouette {
    unsigned programs[SILHOUETTE_PASSES]; /* which pixels, their edges, their colours */
    unsigned target_number;
    unsigned near;    /* DEPTH_COMPONENT16: where an outline may be */
    unsigned edges;   /* RGBA8: which sides of a pixel are edges; silhouette_edges.frag */
    unsigned picture; /* copy of the target's colour */
    unsigned edges_framebuffer, target_framebuffer;
    unsigned target; /* the target's colour as numbers, RGBA8 */
} Silhouette;

/* False when a shader does not compile; silhouette_destroy is needed in either case. */
bool silhouette_create(Silhouette *silhouette, const Subject *subject, Error *error);
void silhouette_destroy(Silhouette *silhouette); /* one of zeros is allowed */

/* Works on the target's colour. `blended` as pass 2 left them, `nearest` the map of depths that was shaded.
   Fluid farther behind than `step`, m, and than its slope explains, is behind an edge. */
void silhouette_draw(Silhouette *silhouette, const SplatMaps *blended, unsigned nearest, float step,
                     const FluidTiles *tiles, const Frame *frame);

#endif
