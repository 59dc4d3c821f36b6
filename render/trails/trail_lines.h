/* The picture of all trails, kept from picture to picture while camera and box stand still: for each pixel
   the newest line there, with its time, scalar and depth. Only what a new state adds is drawn then, however
   long the trails are; how they fade, and what hides them, is found anew for each picture. What is newest is
   never hidden by what has faded.

   On a software driver the CPU draws it (render/trails/trail_sheet.h). There the piece that leads to the
   present state replaces what is below it, as all newer ones do; by the GPU it is blended over that, until it
   is fixed.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_TRAIL_LINES_H
#define SLOSH_TRAIL_LINES_H

#include "render/frame/colormap.h"
#include "render/frame/frame.h"
#include "render/particles/particle_bind.h"
#include "render/trails/trail_sheet.h"
#include "render/trails/trail_store.h"

/* All that the kept picture depends on, besides the columns. */
typedef struct TrailLook {
    TrailSight sight;
    bool by_cpu;
    int width, height;
    Scalar scalar;
    uint64_t drops; /* of the ring */
    uint64_t made;  /* of the store */
} TrailLook;

/* Zero-initialise it. */
typedef struct TrailLines {
    unsigned lines, head, show; /* programs */
    unsigned screen;            /* vertex array without attributes */
    unsigned kept, framebuffer;
    ColorTable colors;
    QuadIndices quads;
    TrailLook look; /* of the kept picture */
    uint64_t drawn; /* columns before this one are in it */
    uint64_t step;  /* columns from one end of its pieces to the other: more than 1 while the look changes */
    bool twice;     /* the picture in hand has had its depths: its colours are of the same pieces */
    TrailSheet sheet;
    TrailPieces *pieces; /* in hand, */
    size_t pieces_room;
} TrailLines;

/* False when a shader does not compile; trail_lines_destroy is needed in either case. */
bool trail_lines_create(TrailLines *lines, Error *error);
void trail_lines_destroy(TrailLines *lines);

/* Into frame->target. Where Frame.more, and camera or box are elsewhere than in the picture before, by fewer
   and longer pieces (TrailsDef.moving). */
void trail_lines_draw(TrailLines *lines, TrailStore *store, const Frame *frame);

/* Whether the last picture had fewer pieces than there are. */
bool trail_lines_unfinished(const TrailLines *lines);

#endif
