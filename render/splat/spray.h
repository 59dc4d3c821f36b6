/* Spray of a clear fluid: particles with almost no neighbours, drawn as single drops. The surface maps
   leave these particles out (APART in shaders): filter and blurred thickness would turn drops into pale
   discs with specks of surface beside.

   A drop is a ball of fluid: the ray is refracted on entry and exit, as in a lens. The background appears
   upside down, with a rim that reflects by Fresnel's formula. */
#ifndef SLOSH_SPRAY_H
#define SLOSH_SPRAY_H

#include "render/frame/behind.h"
#include "render/splat/splat_sprites.h"

typedef struct Spray {
    unsigned find;                     /* program */
    unsigned list, command;            /* buffers: numbers of the drops; drawing command */
    size_t capacity;                   /* capacity of the list */
    unsigned program[SPLAT_POINT + 1]; /* by sprite */
} Spray;

/* For defs with splat_sprays. Returns false if a shader does not compile; call spray_destroy in either
   case. */
bool spray_create(Spray *spray, const SplatSprites *sprites, const Subject *subject, Error *error);
void spray_destroy(Spray *spray); /* a zeroed struct is allowed */

/* Lists the drops among the particles; call before spray_draw. The particles' shapes must be bound
   (ellipsoids_bind). */
void spray_find(Spray *spray, SplatSprite sprite, const ParticleBuffers *particles);

typedef enum SprayPart {
    SPRAY_BEHIND, /* drops behind the fluid's surface (`nearest`, as SplatMaps.nearest): draw before
                     shading the surface */
    SPRAY_BEFORE, /* the remaining drops, tested against the target's depth: draw after shading */
} SprayPart;

/* Draws drops over the target. The background seen through the drops is the target's present picture,
   which `behind` copies. */
void spray_draw(const Spray *spray, SprayPart part, unsigned nearest, Behind *behind, const Edges *edges,
                SplatSprites *sprites, SplatSprite sprite, const ParticleBuffers *particles,
                const Frame *frame);

#endif
