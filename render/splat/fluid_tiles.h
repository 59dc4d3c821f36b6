/* The parts of a picture that the view splat may have to do with, in tiles of TILE x TILE pixels: its passes
   over all pixels are drawn there alone. On a software driver each block of pixels costs, whatever its shader
   does.

   Beside them the maps hold what earlier pictures left: only the map of nearest depths, which is cleared as a
   whole, says where nothing is. */
#ifndef SLOSH_FLUID_TILES_H
#define SLOSH_FLUID_TILES_H

#include "render/frame/frame.h"
#include "sim/base/error.h"

#include <stdbool.h>

typedef struct FluidTiles {
    unsigned list; /* program */
    unsigned marks, rects,
        command;            /* buffers: a word a tile; rectangles of tiles in a row; what draws these */
    unsigned none;          /* vertex array without attributes */
    unsigned target_number; /* of the target that the buffers were made for */
} FluidTiles;

/* False when a shader does not compile; fluid_tiles_destroy is needed in either case. */
bool fluid_tiles_create(FluidTiles *tiles, Error *error);
void fluid_tiles_destroy(FluidTiles *tiles);

/* Makes the buffers anew when the target is another one: then each tile is marked. */
void fluid_tiles_follow(FluidTiles *tiles, const Target *target);

/* Lists what has been marked (shaders/splat/tiles.glsl), with `all` the whole of the box's bounds. */
void fluid_tiles_list(const FluidTiles *tiles, const Frame *frame, bool all);

/* Draws what is listed, each pixel once, at depth 0, with the current program: its vertex shader is
 * FLUID_TILES_VERTEX. */
void fluid_tiles_draw(const FluidTiles *tiles);
#define FLUID_TILES_VERTEX "splat/tiles.vert"

#endif
