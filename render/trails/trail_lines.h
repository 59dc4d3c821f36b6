/* The picture of all trails, kept while camera and box stand still: for each pixel the newest line, with
   time, scalar and depth. A new state adds only its own pieces, however long the trails are; fading and
   hiding are computed for each picture. New pieces are never hidden by faded pieces.

   On a software driver the CPU draws the lines (render/trails/trail_sheet.h). There the piece to the
   present state replaces older pixels, as do all newer pieces; the GPU blends this piece over older pixels
   until the piece is fixed.

   Needs a current OpenGL 4.5 core context. */
#ifndef SLOSH_TRAIL_LINES_H
#define SLOSH_TRAIL_LINES_H

#include "render/frame/colormap.h"
#include "render/frame/frame.h"
#include "render/particles/particle_bind.h"
#include "render/trails/trail_sheet.h"
#include "render/trails/trail_store.h"

/* Inputs of the kept picture, besides the columns. */
typedef struct TrailLook {
    TrailSight sight;
    bool by_cpu;
    int width, height;
    Scalar scalar;
    uint64_t drops; /* drops of the ring */
    uint64_t made;  /* `made` of the store */
} TrailLook;

/* Zero-initialise. */
typedef struct TrailLines {
    unsigned lines, head, show; /* programs */
    unsigned screen;            /* vertex array without attributes */
    unsigned kept, framebuffer;
    ColorTable colors;
    QuadIndices quads;
    TrailLook look; /* inputs of the kept picture */
    uint64_t drawn; /* columns before this number are drawn */
    uint64_t step;  /* columns per piece: more than 1 while the look changes */
    bool twice;     /* this picture's depths are drawn; the colours must use the same pieces */
    TrailSheet sheet;
    TrailPieces *pieces; /* work array */
    size_t pieces_room;
} TrailLines;

/* Returns false if a shader does not compile; call trail_lines_destroy in either case. */
bool trail_lines_create(TrailLines *lines, Error *error);
void trail_lines_destroy(TrailLines *lines);

/* Draws into frame->target. With Frame.more, after a motion of camera or box, with fewer and longer pieces
   (TrailsDef.moving). */
void trail_lines_draw(TrailLines *lines, TrailStore *store, const Frame *frame);

/* True if the last picture had fewer pieces than the trails have. */
bool trail_lines_unfinished(const TrailLines *lines);

#endif
