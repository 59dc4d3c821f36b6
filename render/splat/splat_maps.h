/* The textures between the passes of the view splat. */
#ifndef SLOSH_SPLAT_MAPS_H
#define SLOSH_SPLAT_MAPS_H

#include "render/frame/target.h"

#include <stdint.h>

/* Maps from pass to pass: textures of the target's size. */
typedef struct SplatMaps {
    unsigned target_number; /* number of the target that gave the maps their size */
    unsigned nearest;       /* R32F: least depth of a sphere along the eye's axis, m; SPLAT_NOTHING without
                               a sphere */
    unsigned
        color; /* RGBA16F, on a software driver the faster RGBA32F: sum of weight x linear colour (eq. 8) */
    unsigned normal; /* format of `color`: sum of weight x normal in the eye's frame (eq. 9) */
    unsigned weight; /* R32F: sum of weights (eq. 10); with `covers` RG32F: also the pixel's fraction that
                        fluid covers */
    unsigned limit;  /* DEPTH_COMPONENT32F: the depth at which blending ends */
    unsigned nearest_framebuffer, blend_framebuffer;
} SplatMaps;

/* Value of `nearest` without a sphere; as in splat_depth.frag. */
#define SPLAT_NOTHING 1e30F

/* Makes the maps again for a new target. `covers` must be the same in each call. */
void splat_maps_follow(SplatMaps *maps, const Target *target, bool covers);

void splat_maps_delete(SplatMaps *maps);

/* Number of pixels with a weight, as shading counts. Waits for the GPU. */
uint64_t splat_maps_covered(const SplatMaps *maps, const Target *target);

/* Creates a texture of the target's size, read by nearest texel; the caller deletes the texture. */
unsigned splat_map_create(unsigned format, const Target *target, const char *label);

/* Creates a framebuffer for at most three textures; the caller deletes the framebuffer. */
unsigned splat_framebuffer_create(const unsigned *maps, int count, const char *label);

#endif
