/* The textures between the passes of the view splat. */
#ifndef SLOSH_SPLAT_MAPS_H
#define SLOSH_SPLAT_MAPS_H

#include "render/frame/target.h"

#include <stdint.h>

/* What the passes leave for the next: textures as large as the target. */
typedef struct SplatMaps {
    unsigned target_number; /* of the target that they were made for */
    unsigned nearest;       /* R32F: least depth of a sphere along the eye's axis, m; SPLAT_NOTHING where none
                               is */
    unsigned
        color; /* RGBA16F, on a software driver the faster RGBA32F: sum of weight x linear colour (eq. 8) */
    unsigned normal; /* the same: sum of weight x normal in the eye's frame (eq. 9) */
    unsigned weight; /* R32F: sum of weights (eq. 10); with `covers` RG32F: and what the fluid covers of the
                        pixel */
    unsigned limit;  /* DEPTH_COMPONENT32F: the depth at which blending ends */
    unsigned nearest_framebuffer, blend_framebuffer;
} SplatMaps;

/* In `nearest` where no sphere is; as in splat_depth.frag. */
#define SPLAT_NOTHING 1e30F

/* Makes the maps anew when the target is another one. `covers`: the same in each call. */
void splat_maps_follow(SplatMaps *maps, const Target *target, bool covers);

void splat_maps_delete(SplatMaps *maps);

/* Pixels with a weight, as shading finds them. Waits for the drawing. */
uint64_t splat_maps_covered(const SplatMaps *maps, const Target *target);

/* A texture as large as the target, read by its nearest texel; the caller deletes it. */
unsigned splat_map_create(unsigned format, const Target *target, const char *label);

/* A framebuffer that writes into these textures, at most three; the caller deletes it. */
unsigned splat_framebuffer_create(const unsigned *maps, int count, const char *label);

#endif
