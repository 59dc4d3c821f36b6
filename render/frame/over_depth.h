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

/* Depths as the target has them now; the target to draw the others into, which has no colour. */
Target over_depth_begin(OverDepth *over, const Target *target);

void over_depth_destroy(OverDepth *over); /* a zeroed one is allowed */

#endif
