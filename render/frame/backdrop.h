/* The backdrop: sky and floor, the first thing in a picture, the floor with Frame.floor_light. Writes the
   target's colour; no depth.

   Without the fluid's shadow it depends on the camera alone, so it is kept while that stands still: then a
   picture costs a copy, and shading where the shadow may lie. */
#ifndef SLOSH_BACKDROP_H
#define SLOSH_BACKDROP_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

enum { BACKDROP_KEY_SIZE = 32 };

typedef struct Backdrop {
    unsigned program, shadow_program, vertex_array;
    double seen[BACKDROP_KEY_SIZE]; /* all that sky and lit floor of the last picture depend on */
    bool kept;                      /* `kept_color` holds the backdrop of `seen` */
    unsigned kept_framebuffer, kept_color;
    unsigned kept_target; /* number of the target whose size both have; 0: neither is made yet */
} Backdrop;

bool backdrop_create(Backdrop *backdrop, Error *error);
void backdrop_destroy(Backdrop *backdrop);
void backdrop_draw(Backdrop *backdrop, const Frame *frame);

#endif
