/* The edges of the box: thin, smooth lines, hidden by objects in front. Blends colour and tests depth;
   writes depth if Frame.depths. */
#ifndef SLOSH_EDGES_H
#define SLOSH_EDGES_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

typedef struct Edges {
    unsigned program;
    unsigned vertex_array, indices;
} Edges;

bool edges_create(Edges *edges, Error *error);
void edges_destroy(Edges *edges);
void edges_draw(const Edges *edges, const Frame *frame);

/* Draws the edges seen only through the box: between two sides that face away from the eye. */
void edges_draw_behind(const Edges *edges, const Frame *frame, unsigned framebuffer);

/* Draws with `program`, the shaders compiled with COARSE, into the bound framebuffer, whose colours are
   encoded. Tests against `depth`, a depth texture of another size. */
void edges_draw_enlarged(const Edges *edges, unsigned program, const Frame *frame, unsigned depth);

#endif
