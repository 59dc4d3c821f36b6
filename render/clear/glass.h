/* The panes of a box of glass: faint mirrors of sky and floor, by Fresnel's formula. Blends colour, tests
   depth, leaves it as it is. Their edges are those of render/frame/edges.h. */
#ifndef SLOSH_GLASS_H
#define SLOSH_GLASS_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

typedef struct Glass {
    unsigned program; /* 0: not made yet */
    unsigned vertex_array;
} Glass;

/* False when a shader does not compile. Nothing is done where it is made already. */
bool glass_create(Glass *glass, Error *error);
void glass_destroy(Glass *glass); /* zeroed is allowed */

/* Draws the panes that face away from the eye (`behind`: before what is in the box) or the others (after it).
 */
void glass_draw(const Glass *glass, const Frame *frame, bool behind);

#endif
