/* The scene's solids as translucent surfaces: kept points on the triangles of the meshes
   (render/pbsr/still_layers.h), in each solid's own frame. A moving solid keeps its points. */
#ifndef SLOSH_SOLID_LAYERS_H
#define SLOSH_SOLID_LAYERS_H

#include "render/frame/frame.h"
#include "render/pbsr/average.h"
#include "render/pbsr/still_layers.h"

/* Numbers from SOLID_NUMBERS to OUTSIDE_NUMBER are of solids with colours of their own. */
enum { SOLID_NUMBERS = PBSR_LAYERS_MAX, SOLID_COLORS_MAX = OUTSIDE_NUMBER - SOLID_NUMBERS };

/* Zero-initialise. */
typedef struct SolidLayers {
    int count, layer; /* number of drawn solids, 0 without a layer of solids; number of this layer in the
                         list */
    int moving;       /* StillLayer.moving, set by the caller */
    StillLayer still[SOLIDS_MAX]; /* together limited to the points of one layer */
    /* inputs of the points */
    SolidDef shapes[SOLIDS_MAX];
    double slab;
    unsigned numbers[SOLIDS_MAX];
} SolidLayers;

/* The number of the layer of solids in the list; the first if there are several; -1: none. */
int solid_layers_number(const PbsrDef *def);

/* The number of different colours of solids: more than SOLID_COLORS_MAX need a colour of the layer. */
int solid_layers_colors(const WorldDef *world);

/* Fills in the looks of solids with colours of their own. */
void solid_layers_look(const PbsrDef *def, const WorldDef *world, AverageLook looks[AVERAGE_NUMBERS_MAX]);

/* As still_layer_follow, for all solids at `time`, s. */
void solid_layers_follow(SolidLayers *layers, const PbsrDef *def, double time, const Frame *frame,
                         const SetSight *sight);

void solid_layers_free(SolidLayers *layers); /* a zeroed struct is allowed */

#endif
