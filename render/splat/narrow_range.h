/* The depth of the view splat smoothed on the screen, and normals from it: a filter that keeps to one
   surface, for comparison with blending. After: Truong, Yuksel, A narrow-range filter for screen-space fluid
   rendering, PACMCGIT 1 (1), 2018 (I3D).

   A neighbour beyond the range around a pixel's depth is left out, with the one opposite, so that the mean
   does not lean. What lies within widens the range for those beyond, on each side of a pass. The kernel has
   one size in the world; passes along x and y, then a small one in two dimensions. Where we differ: what is
   too far behind is left out as what is too near is (in the paper it counts as if it were a radius behind,
   which lifts a level seen at a slant towards its far end); means and ranges are of 1 / depth, in which a
   plane is linear on the screen and stays one; weights are (1 - q^2)^3, which end at 0, instead of a cut
   Gaussian. */
#ifndef SLOSH_NARROW_RANGE_H
#define SLOSH_NARROW_RANGE_H

#include "render/frame/frame.h"
#include "render/splat/splat_maps.h"
#include "sim/base/error.h"

/* Samples on each side of a pass are at most so many: a wider kernel takes each second, third, ... pixel. */
enum { NARROW_RANGE_TAPS = 32 };

typedef struct NarrowRange {
    unsigned along, clean, normals; /* programs */
    unsigned screen;                /* vertex array without attributes */
    unsigned target_number;         /* of the target that the maps were made for */
    unsigned depth[2];              /* R32F, as SplatMaps.nearest; written in turns */
    unsigned normal;                /* as SplatMaps.normal, but of unit length; 0 where nothing is */
    unsigned depth_framebuffer[2], normal_framebuffer;
} NarrowRange;

/* `panes`: the maps have some (render/splat/panes.h). False when a shader does not compile;
 * narrow_range_destroy is needed in either case. */
bool narrow_range_create(NarrowRange *filter, bool panes, Error *error);
void narrow_range_destroy(NarrowRange *filter); /* one of zeros is allowed */

/* The maps with `nearest` and `normal` replaced by the filter's own, which it keeps. Settings are those of
   splat_def of the frame. */
SplatMaps narrow_range_draw(NarrowRange *filter, const SplatMaps *maps, const Frame *frame);

#endif
