/* The edges of the box: thin, smooth lines, hidden by what is in front of them. Blends colour, tests depth;
   leaves its own where Frame.depths. */
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

/* Those that are seen through the box only, between two sides that face away from the eye. */
void edges_draw_behind(const Edges *edges, const Frame *frame, unsigned framebuffer);

/* Into the framebuffer that is bound, whose colours are encoded, with `program`: that of the shaders for
   COARSE; behind a texture of depths of another size. */
void edges_draw_enlarged(const Edges *edges, unsigned program, const Frame *frame, unsigned depth);

#endif
