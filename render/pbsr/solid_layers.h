/* The scene's solids as translucent surfaces: points on the triangles of their meshes that stay
   (render/pbsr/still_layers.h), each solid's in a frame of its own. A solid that moves keeps its points. */
#ifndef SLOSH_SOLID_LAYERS_H
#define SLOSH_SOLID_LAYERS_H

#include "render/frame/frame.h"
#include "render/pbsr/average.h"
#include "render/pbsr/still_layers.h"

/* Numbers from here to OUTSIDE_NUMBER are of solids that have colours of their own. */
enum { SOLID_NUMBERS = PBSR_LAYERS_MAX, SOLID_COLORS_MAX = OUTSIDE_NUMBER - SOLID_NUMBERS };

/* Zero-initialise it. */
typedef struct SolidLayers {
    int count, layer; /* solids that are drawn, by which layer of the list; 0: there is no such layer */
    int moving;       /* StillLayer.moving, said by its user */
    StillLayer still[SOLIDS_MAX]; /* all together have the points that a layer may have */
    /* what they were made for */
    SolidDef shapes[SOLIDS_MAX];
    double slab;
    unsigned numbers[SOLIDS_MAX];
} SolidLayers;

/* The number of the layer of solids in the list; -1: there is none. Of several it is the first. */
int solid_layers_number(const PbsrDef *def);

/* How many colours the solids have: more than SOLID_COLORS_MAX cannot be told apart without one of the layer.
 */
int solid_layers_colors(const WorldDef *world);

/* Fills in the looks of solids that have colours of their own. */
void solid_layers_look(const PbsrDef *def, const WorldDef *world, AverageLook looks[AVERAGE_NUMBERS_MAX]);

/* As still_layer_follow, of all solids as they are at `time`, s. */
void solid_layers_follow(SolidLayers *layers, const PbsrDef *def, double time, const Frame *frame,
                         const SetSight *sight);

void solid_layers_free(SolidLayers *layers); /* a zeroed one is allowed */

#endif
