/* What stands behind a clear fluid: a copy of the target's colour and depth, for shaders that look through.
   shaders/common/behind.glsl reads it. */
#ifndef SLOSH_BEHIND_H
#define SLOSH_BEHIND_H

#include "render/frame/edges.h"

typedef struct Behind {
    unsigned target_number; /* number of the target whose size the textures have */
    unsigned color, depth;  /* textures like the target's; no depth without solids */
    unsigned framebuffer;   /* the colour, before the target's depth */
} Behind;

/* Copies what is drawn up to now and binds it to texture units 14 (colour), 15 (depth, of a scene with
   solids) and 3 (what of the light arrives on the floor). `edges`: adds those of the box that are behind what
   is in it, where the picture has a box; NULL: none. All zero at first. */
void behind_take(Behind *behind, const Edges *edges, const Frame *frame);

/* For shaders that find sky and floor by themselves: the copy holds nothing but these edges, multiplied by
   what they cover, which alpha says. Binds units 14 and 3. */
void behind_take_edges(Behind *behind, const Edges *edges, const Frame *frame);

void behind_destroy(Behind *behind);

#endif
