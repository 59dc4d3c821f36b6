/* The parts of a picture where the view splat may draw, in tiles of TILE x TILE pixels: full-screen passes
   are drawn only there. On a software driver each block of pixels costs time, whatever the shader does.

   Outside the tiles, the maps hold data of earlier pictures. Only the map of nearest depths is cleared
   completely and marks pixels without fluid. */
#ifndef SLOSH_FLUID_TILES_H
#define SLOSH_FLUID_TILES_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

#include <stdbool.h>

typedef struct FluidTiles {
    unsigned list; /* program */
    unsigned marks, rects,
        command;            /* buffers: a word per tile; rectangles of tiles in a row; drawing command */
    unsigned none;          /* vertex array without attributes */
    unsigned target_number; /* number of the target that gave the buffers their size */
} FluidTiles;

/* Returns false if a shader does not compile; call fluid_tiles_destroy in either case. */
bool fluid_tiles_create(FluidTiles *tiles, Error *error);
void fluid_tiles_destroy(FluidTiles *tiles);

/* Makes the buffers again for a new target: then all tiles are marked. */
void fluid_tiles_follow(FluidTiles *tiles, const Target *target);

/* Lists the marked tiles (shaders/splat/tiles_list.comp); `all`: all tiles in the box's bounds. */
void fluid_tiles_list(const FluidTiles *tiles, const Frame *frame, bool all);

/* Draws the listed tiles, each pixel once, at depth 0, with the current program. The program's vertex
   shader must be FLUID_TILES_VERTEX. */
void fluid_tiles_draw(const FluidTiles *tiles);
#define FLUID_TILES_VERTEX "splat/tiles.vert"

#endif
