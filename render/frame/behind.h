/* The background of a clear fluid: a copy of the target's colour and depth, for shaders of refraction.
   shaders/common/behind.glsl reads the copy. */
#ifndef SLOSH_BEHIND_H
#define SLOSH_BEHIND_H

#include "render/frame/edges.h"

typedef struct Behind {
    unsigned target_number; /* number of the target that gave the textures their size */
    unsigned color, depth;  /* textures like the target's; no depth without solids */
    unsigned framebuffer;   /* the colour texture with the target's depth */
} Behind;

/* Copies the picture so far and binds the copy to texture units 14 (colour), 15 (depth, if the scene has
   solids) and 3 (light on the floor). `edges`: the box's far edges are added if the picture shows the box;
   NULL: none. Zero-initialise *behind. */
void behind_take(Behind *behind, const Edges *edges, const Frame *frame);

/* For shaders that compute sky and floor themselves: the copy holds only these edges, colour multiplied by
   coverage, and the coverage in alpha. Binds units 14 and 3. */
void behind_take_edges(Behind *behind, const Edges *edges, const Frame *frame);

void behind_destroy(Behind *behind);

#endif
