/* The backdrop: sky and floor, the first pass of a picture; the floor is lit by Frame.floor_light. Writes
   the target's colour; no depth.

   Without the fluid's shadow the backdrop depends on the camera alone and is kept while the camera stands
   still. Then a picture costs a copy, and shading of the floor area that the shadow may reach. */
#ifndef SLOSH_BACKDROP_H
#define SLOSH_BACKDROP_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

enum { BACKDROP_KEY_SIZE = 32 };

typedef struct Backdrop {
    unsigned program, shadow_program, vertex_array;
    double seen[BACKDROP_KEY_SIZE]; /* all inputs of sky and lit floor in the last picture */
    bool kept;                      /* `kept_color` holds the backdrop of `seen` */
    unsigned kept_framebuffer, kept_color;
    unsigned kept_target; /* number of the target that gave both objects their size; 0: not created yet */
} Backdrop;

bool backdrop_create(Backdrop *backdrop, Error *error);
void backdrop_destroy(Backdrop *backdrop);
void backdrop_draw(Backdrop *backdrop, const Frame *frame);

#endif
