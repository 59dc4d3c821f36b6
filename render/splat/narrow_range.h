/* Smooths the depth of the view splat on the screen and computes normals: an edge-preserving filter, for
   comparison with blending. After: Truong, Yuksel, A narrow-range filter for screen-space fluid rendering,
   PACMCGIT 1 (1), 2018 (I3D).

   A sample with a depth outside the range around the pixel's depth is left out together with the opposite
   sample, so that the mean stays centred. A sample inside widens the range for samples farther out, on
   each side of a pass. The kernel has one size in the world. Passes run along x and y, then a small pass
   in two dimensions.

   Differences from the paper. Samples too far behind are left out, as are samples too near; the paper
   counts far samples as one radius behind, which lifts an inclined level surface towards its far end.
   Means and ranges are of 1 / depth, which is linear on the screen for a plane, so that planes stay
   planes. Weights are (1 - q^2)^3, which end at 0, instead of a cut Gaussian. */
#ifndef SLOSH_NARROW_RANGE_H
#define SLOSH_NARROW_RANGE_H

#include "render/frame/frame.h"
#include "render/splat/splat_maps.h"
#include "sim/base/error.h"

/* At most this many samples on each side of a pass: wider kernels take each second, third, ... pixel. */
enum { NARROW_RANGE_TAPS = 32 };

typedef struct NarrowRange {
    unsigned along, clean, normals; /* programs */
    unsigned screen;                /* vertex array without attributes */
    unsigned target_number;         /* number of the target that gave the maps their size */
    unsigned depth[2];              /* R32F, as SplatMaps.nearest; written alternately */
    unsigned normal;                /* as SplatMaps.normal, but of unit length; 0 where there is no fluid */
    unsigned depth_framebuffer[2], normal_framebuffer;
} NarrowRange;

/* `panes`: the maps come from render/splat/panes.h. Returns false if a shader does not compile; call
   narrow_range_destroy in either case. */
bool narrow_range_create(NarrowRange *filter, bool panes, Error *error);
void narrow_range_destroy(NarrowRange *filter); /* a zeroed struct is allowed */

/* Returns the maps with `nearest` and `normal` replaced by the filter's own maps, which the filter owns.
   Reads the frame's splat_def. */
SplatMaps narrow_range_draw(NarrowRange *filter, const SplatMaps *maps, const Frame *frame);

#endif
