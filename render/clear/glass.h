/* The panes of a glass box: faint reflections of sky and floor, by Fresnel's formula. Blends colour; tests
   depth but writes none. The edges of the panes: render/frame/edges.h. */
#ifndef SLOSH_GLASS_H
#define SLOSH_GLASS_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

typedef struct Glass {
    unsigned program; /* 0: not created yet */
    unsigned vertex_array;
} Glass;

/* Returns false if a shader does not compile. Does nothing if already created. */
bool glass_create(Glass *glass, Error *error);
void glass_destroy(Glass *glass); /* a zeroed struct is allowed */

/* `behind`: draws the panes that face away from the eye (call before drawing the box's contents); else the
   panes that face the eye (call after). */
void glass_draw(const Glass *glass, const Frame *frame, bool behind);

#endif
