/* Spray of a clear fluid: particles with next to no neighbours, each drawn as the drop that it is. The maps
   of the surface leave them out (APART in shaders): a filter and a thickness blurred over the support radius
   would make pale discs of them, and specks of the surface beside them.

   A drop is a ball of the fluid of its own: the ray is bent where it enters and where it leaves, as in
   a lens, so that what is behind is seen upside down, with a rim that mirrors by Fresnel's formula. */
#ifndef SLOSH_SPRAY_H
#define SLOSH_SPRAY_H

#include "render/frame/behind.h"
#include "render/splat/splat_sprites.h"

typedef struct Spray {
    unsigned find;                     /* program */
    unsigned list, command;            /* buffers: numbers of the drops; what draws them */
    size_t capacity;                   /* of the list */
    unsigned program[SPLAT_POINT + 1]; /* by sprite */
} Spray;

/* Where a def wants it: splat_sprays. False when a shader does not compile; spray_destroy is needed in either
   case. */
bool spray_create(Spray *spray, const SplatSprites *sprites, const Subject *subject, Error *error);
void spray_destroy(Spray *spray); /* zeroed is allowed */

/* Lists the drops among the particles, whose shapes are bound (ellipsoids_bind): before spray_draw. */
void spray_find(Spray *spray, SplatSprite sprite, const ParticleBuffers *particles);

typedef enum SprayPart {
    SPRAY_BEHIND, /* what is behind the fluid's surface (`nearest`, as SplatMaps.nearest): before that is
                     shaded */
    SPRAY_BEFORE, /* the rest, by the target's depth: after that */
} SprayPart;

/* Draws drops over the target, seen through them what it holds now, which `behind` takes. */
void spray_draw(const Spray *spray, SprayPart part, unsigned nearest, Behind *behind, const Edges *edges,
                SplatSprites *sprites, SplatSprite sprite, const ParticleBuffers *particles,
                const Frame *frame);

#endif
