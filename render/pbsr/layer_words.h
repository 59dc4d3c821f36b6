/* Texts for users about the layers of the view pbsr. */
#ifndef SLOSH_LAYER_WORDS_H
#define SLOSH_LAYER_WORDS_H

#include "render/pbsr/fluid_walk.h"
#include "render/pbsr/solid_layers.h"

enum { LAYER_WORDS_SIZE = 64 };

/* "pressure 1500 Pa", "slice_x at 0.1 m", "surface". */
void layer_words(const PbsrLayer *said, char words[LAYER_WORDS_SIZE]);

/* The layers and sets of a picture. */
typedef struct LayersDrawn {
    const PbsrDef *def;
    const FluidLayers *layers;
    const FluidWalk *walks;  /* array of PBSR_LAYERS_MAX */
    const StillLayer *still; /* array of PBSR_LAYERS_MAX */
    const SolidLayers *solids;
    bool by_gpu;                /* the GPU projects */
    int sets;                   /* sets of the finished picture */
    bool uncounted, over_lacks; /* no memory: to count points; for the depths of lines and arrows */
} LayersDrawn;

/* Describes what differs from the def, parts separated by "; ". Returns the length; 0: nothing differs. */
size_t layers_lack(const LayersDrawn *drawn, char *text, size_t size);

#endif
