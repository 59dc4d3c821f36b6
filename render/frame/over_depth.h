/* Depths of all objects drawn over a view, including lines without depth in the picture: for a view with
   parts in front of and behind these objects (ViewKind.draw_front). Needs a current OpenGL 4.5 core
   context. */
#ifndef SLOSH_OVER_DEPTH_H
#define SLOSH_OVER_DEPTH_H

#include "render/frame/target.h"

/* Zero-initialise. */
typedef struct OverDepth {
    unsigned framebuffer, depth; /* GL names; depth format as in Target */
    int width, height;
} OverDepth;

/* Copies the target's present depths; `to`: a target without colour, for the overlays' and edges' depths.
   Returns false if the driver has no memory. */
bool over_depth_begin(OverDepth *over, const Target *target, Target *to);

void over_depth_destroy(OverDepth *over); /* a zeroed struct is allowed */

#endif
