/* Length of fluid on each ray before the first solid, m: the integral along the ray of the fluid's field
   sum V W(r - r_j, h), with V a particle's volume at rest, spacing^3. Inside the fluid the field is 1, so
   the integral is the length inside. W is poly6 (Müller et al. 2003); the integral along a line at a
   distance b from the centre is 9 / (2 pi h^2) (1 - b^2 / h^2)^(7/2). */
#ifndef SLOSH_THICKNESS_H
#define SLOSH_THICKNESS_H

#include "render/splat/splat_sprites.h"

typedef struct Thickness {
    unsigned target_number, cell; /* the target's number; target pixels along a texel */
    unsigned map, filled;         /* R32F, m: of the fluid; of a box full of fluid; linear filter */
    unsigned framebuffer, filled_framebuffer;
    unsigned fill, screen;             /* program of the map `filled`; vertex array without attributes */
    unsigned program[SPLAT_POINT + 1]; /* by sprite */
} Thickness;

/* Returns false if a shader does not compile; call thickness_destroy in either case. */
bool thickness_create(Thickness *thickness, const SplatSprites *sprites, bool solids, Error *error);
void thickness_destroy(Thickness *thickness);

/* Fills the maps, as coarse as the support radius allows: the field has no finer detail. Solids must
   already be in the target's depth. */
void thickness_draw(Thickness *thickness, SplatSprites *sprites, const ParticleBuffers *particles,
                    const Frame *frame);

#endif
