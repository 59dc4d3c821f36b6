/* A picture with fewer pixels than it is shown with: what it is drawn into, and how it becomes as large as it
   is shown. What has all pixels, edges and words, is drawn over that. Needs a current OpenGL 4.5 core
   context. */
#ifndef SLOSH_COARSE_H
#define SLOSH_COARSE_H

#include "render/frame/target.h"

/* Zero-initialise it: then the picture has all pixels. */
typedef struct Coarse {
    Target target;                     /* framebuffer 0: there is none */
    unsigned encoded;                  /* texture: the target's colour as the bytes that it is */
    unsigned program, edges, vertices; /* `edges`: those of render/frame/edges.h behind the target's depth */
} Coarse;

/* Follows a picture of that size of which the part `resolution`, 0 .. 1, is drawn each way; 1: all zeroed. On
   failure all stays as it was. */
bool coarse_follow(Coarse *coarse, double resolution, int width, int height, Error *error);
void coarse_destroy(Coarse *coarse);

/* Fills a framebuffer of that size with the colour, smoothly; leaves it bound, encoding of sRGB off. The
   weights are of the encoded colour: of linear light they cost a software driver twice the time. */
void coarse_enlarge(const Coarse *coarse, unsigned framebuffer, int width, int height);

/* The depth as it is, into that of a target of any size. */
void coarse_enlarge_depth(const Coarse *coarse, const Target *to);

#endif
