/* The depths of what is drawn over a view, lines too that leave none in the picture: for a view whose parts
   lie before and behind it (ViewKind.draw_front). Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_OVER_DEPTH_H
#define SLOSH_OVER_DEPTH_H

#include "render/frame/target.h"

/* Zero-initialise it. */
typedef struct OverDepth {
    unsigned framebuffer, depth; /* GL names; depth as that of a target */
    int width, height;
} OverDepth;

/* Depths as the target has them now; `to`: the target to draw the others into, which has no colour. False
   where the driver has no memory for them. */
bool over_depth_begin(OverDepth *over, const Target *target, Target *to);

void over_depth_destroy(OverDepth *over); /* a zeroed one is allowed */

#endif
