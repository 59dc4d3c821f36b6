/* A coarse picture: drawn with fewer pixels than shown, then enlarged. Edges and text are drawn at full
   resolution over the enlarged picture. Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_COARSE_H
#define SLOSH_COARSE_H

#include "render/frame/target.h"

/* Zero-initialise: then pictures have full resolution. */
typedef struct Coarse {
    Target target;                     /* framebuffer 0: no coarse picture */
    unsigned encoded;                  /* texture view of the target's colour, as sRGB-encoded bytes */
    unsigned program, edges, vertices; /* `edges`: program for render/frame/edges.h, tested against the
                                          target's depth */
} Coarse;

/* Adapts to a picture of `width` x `height` pixels, drawn at the fraction `resolution` (0 .. 1) along each
   axis; 1: all zero. Returns false on failure and changes nothing. */
bool coarse_follow(Coarse *coarse, double resolution, int width, int height, Error *error);
void coarse_destroy(Coarse *coarse);

/* Fills a framebuffer of `width` x `height` pixels with the colour, interpolated linearly. Leaves the
   framebuffer bound and sRGB encoding off. Interpolates encoded colours: linear light would cost a
   software driver twice the time. */
void coarse_enlarge(const Coarse *coarse, unsigned framebuffer, int width, int height);

/* Copies the depth, not interpolated, into a target of any size. */
void coarse_enlarge_depth(const Coarse *coarse, const Target *to);

#endif
