/* The surface of the view splat where the fluid touches a wall of the box, for clear shadings: spheres
   stick out of the wall, but the visible surface is the pane. Cuts the map of nearest depths at the box. A
   ray that meets fluid at the wall where it enters gets minus the wall's depth: the filter leaves negative
   depths unchanged, and shading recognises a pane. A ray that meets fluid only outside the box gets no
   depth. */
#ifndef SLOSH_PANES_H
#define SLOSH_PANES_H

#include "render/splat/fluid_tiles.h"
#include "render/splat/splat_maps.h"
#include "sim/base/error.h"

typedef struct Panes {
    unsigned cut, brim;              /* programs */
    unsigned target_number;          /* number of the target that gave the maps their size */
    unsigned map[2], framebuffer[2]; /* R32F, m: cut; and with smooth rims, by the majority of pixels
                                        around */
} Panes;

/* Returns false if a shader does not compile; call panes_destroy in either case. */
bool panes_create(Panes *panes, Error *error);
void panes_destroy(Panes *panes); /* a zeroed struct is allowed */

/* Returns `maps` with the cut depths. */
SplatMaps panes_draw(Panes *panes, const SplatMaps *maps, const FluidTiles *tiles, const Frame *frame);

#endif
