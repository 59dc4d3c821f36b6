/* The picture of all trails where the CPU draws it (render/trails/trail_rows.h): what is fixed is kept, the
   piece that leads to the present state is drawn over it; only blocks in which something is are laid over the
   view.

   Needs a current OpenGL 4.5 core context of a software driver. */
#ifndef SLOSH_TRAIL_SHEET_H
#define SLOSH_TRAIL_SHEET_H

#include "render/trails/trail_rows.h"
#include "sim/base/error.h"

/* Zero-initialise it. */
typedef struct TrailSheet {
    unsigned program;
    unsigned none;           /* vertex array without attributes */
    TrailPicture kept;       /* of what is fixed: in memory; */
    TrailPicture shown;      /* the same with the present state: in a buffer that stays mapped, */
    unsigned pixels, texels; /* which is this one and this texture */
    uint8_t *changed;        /* tiles of `kept`, since it was last copied into `shown` */
    unsigned list;           /* buffer that stays mapped: */
    uint32_t *block;         /* rows of blocks to show: row, first and end, 10 bits each, */
    size_t blocks;           /* so many; a software driver has tiles of that size, and is quick where one is
                                covered whole */
    TrailRows rows;
} TrailSheet;

/* False when the shader does not compile; trail_sheet_destroy is needed in either case. */
bool trail_sheet_create(TrailSheet *sheet, Error *error);
void trail_sheet_destroy(TrailSheet *sheet);

/* For pictures of that size; *anew: nothing is there now. False when memory is short. Nothing that reads the
   sheet may be under way, here and in what follows. */
bool trail_sheet_follow(TrailSheet *sheet, int width, int height, bool *anew);

/* Nothing is fixed any more. */
void trail_sheet_clear(TrailSheet *sheet);

/* As trail_rows_draw: `fixed` columns that stay, and behind them `count - fixed` that the next call leaves
   out. */
bool trail_sheet_draw(TrailSheet *sheet, const TrailSight *sight, const TrailPieces *pieces, size_t fixed,
                      size_t count, size_t slots);

/* Lays it over the bound target, by the GL state and the uniforms of the program that are set. */
void trail_sheet_show(const TrailSheet *sheet);

#endif
