/* How much fluid lies on each ray before the first solid, in m: the integral along it of the fluid's field
   sum V W(r - r_j, h), V a particle's volume at rest, spacing^3. Inside the fluid the field is 1, so that
   this is the length of the ray in it. W is poly6 (Müller et al. 2003), of which the integral along a line
   that passes at a distance b is 9 / (2 pi h^2) (1 - b^2 / h^2)^(7/2). */
#ifndef SLOSH_THICKNESS_H
#define SLOSH_THICKNESS_H

#include "render/splat/splat_sprites.h"

typedef struct Thickness {
    unsigned target_number, cell; /* the target's number; pixels of the target along a texel */
    unsigned map, filled;         /* R32F, m: of the fluid, and of a box full of it; linear filter */
    unsigned framebuffer, filled_framebuffer;
    unsigned fill, screen;             /* program of the second map; vertex array without attributes */
    unsigned program[SPLAT_POINT + 1]; /* by sprite */
} Thickness;

/* False when a shader does not compile; thickness_destroy is needed in either case. */
bool thickness_create(Thickness *thickness, const SplatSprites *sprites, bool solids, Error *error);
void thickness_destroy(Thickness *thickness);

/* Fills the map. It is as coarse as the support radius allows: the field has no finer detail. Solids are in
   the target's depth already. */
void thickness_draw(Thickness *thickness, SplatSprites *sprites, const ParticleBuffers *particles,
                    const Frame *frame);

#endif
