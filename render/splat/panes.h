/* The surface of the view splat where the fluid stands at a wall of the box, for clear shadings: spheres
   stick out of the wall, one sees a pane. Cuts the map of nearest depths to the box: a ray that meets fluid
   at the wall by which it enters has there the wall's own depth, less than zero, that the filter leaves as it
   is and shading knows it; a ray that meets fluid beyond the box only has none. */
#ifndef SLOSH_PANES_H
#define SLOSH_PANES_H

#include "render/splat/fluid_tiles.h"
#include "render/splat/splat_maps.h"
#include "sim/base/error.h"

typedef struct Panes {
    unsigned cut, brim;              /* programs */
    unsigned target_number;          /* of the target that the maps were made for */
    unsigned map[2], framebuffer[2]; /* R32F, m: cut; and with a smooth brim, by most of the pixels around */
} Panes;

/* False when the shader does not compile; panes_destroy is needed in either case. */
bool panes_create(Panes *panes, Error *error);
void panes_destroy(Panes *panes); /* zeroed is allowed */

/* Those maps with the depths that are cut. */
SplatMaps panes_draw(Panes *panes, const SplatMaps *maps, const FluidTiles *tiles, const Frame *frame);

#endif
