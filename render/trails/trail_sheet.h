/* The picture of all trails drawn by the CPU (render/trails/trail_rows.h). Fixed pieces are kept, pieces
   to the present state are drawn over these; only blocks with trails are drawn over the view.

   Needs a current OpenGL 4.5 core context of a software driver. */
#ifndef SLOSH_TRAIL_SHEET_H
#define SLOSH_TRAIL_SHEET_H

#include "render/trails/trail_rows.h"
#include "sim/base/error.h"

/* Zero-initialise. */
typedef struct TrailSheet {
    unsigned program;
    unsigned none;           /* vertex array without attributes */
    TrailPicture kept;       /* the fixed pieces, in memory */
    TrailPicture shown;      /* with the present state, in a mapped buffer */
    unsigned pixels, texels; /* that buffer and its texture */
    uint8_t *changed;        /* tiles of `kept` changed since the last copy to `shown` */
    unsigned list;           /* mapped buffer: */
    uint32_t *block;         /* rows of blocks to show: row, first and end, 10 bits each */
    size_t blocks;           /* length of `block`; a software driver has tiles of the block's size, and
                                fills whole tiles fast */
    TrailRows rows;
} TrailSheet;

/* Returns false if the shader does not compile; call trail_sheet_destroy in either case. */
bool trail_sheet_create(TrailSheet *sheet, Error *error);
void trail_sheet_destroy(TrailSheet *sheet);

/* Adapts to pictures of width x height; *anew: the picture is empty now. Returns false if memory is short.
   The GPU must not be reading the sheet, in this function and the next two. */
bool trail_sheet_follow(TrailSheet *sheet, int width, int height, bool *anew);

/* Removes the fixed pieces. */
void trail_sheet_clear(TrailSheet *sheet);

/* As trail_rows_draw: `fixed` columns to keep, then `count - fixed` columns for this picture only. */
bool trail_sheet_draw(TrailSheet *sheet, const TrailSight *sight, const TrailPieces *pieces, size_t fixed,
                      size_t count, size_t slots);

/* Draws the sheet over the bound target. The caller sets GL state and uniforms of the program. */
void trail_sheet_show(const TrailSheet *sheet);

#endif
