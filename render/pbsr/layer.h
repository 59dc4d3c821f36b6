/* What a layer of the view pbsr lies on, and its points: triangles, or the cells of a volume. */
#ifndef SLOSH_LAYER_H
#define SLOSH_LAYER_H

#include "render/pbsr/set_image.h"

#include <stdbool.h>

/* How many points of one set are expected on a triangle or in a cell as one sees it. */
typedef struct LayerShare {
    float expected; /* where all of it were at depth w = nearest */
    float nearest;  /* m; a point at depth w stays with the probability (nearest / w)^2 */
} LayerShare;

/* Zero-initialise it. The arrays belong to it. */
typedef struct Layer {
    size_t point_count, triangle_count; /* without triangles points are the centres of cells */
    size_t point_capacity, triangle_capacity, share_capacity;
    LayerPoint *point;
    uint32_t (*triangle)[3];
    LayerShare *share; /* of each triangle or cell */
    double cell[3];    /* sides of a cell, m */
    bool slab;         /* cells are one layer, as deep as that along z, everywhere as dense */
    double density;    /* points of a set on as much surface as a pixel shows; of cells: by m */
    unsigned number;   /* 0 .. 15 */
    double curved;     /* 0 and up: so many times as many points more where a surface is bent */
    double support;    /* m: by that radius, or less, and in proportion to its inverse beyond */
    double beyond;     /* as last seen: so many times the points that are strewn would be needed on the piece
                          that is largest; 1 and less: none is too large */
} Layer;

/* Room for that many; what was there is lost. */
bool layer_reserve(Layer *layer, size_t points, size_t triangles);
void layer_free(Layer *layer); /* a zeroed one is allowed */

/* Fills in its shares as they are seen; the same bits for any number of threads. False when memory is short.
 */
bool layer_share(Layer *layer, const SetSight *sight);

/* The part of the points that its opacity needs where a piece is largest, up to 1. */
double layer_part(const Layer *layer);

/* Projects set number `set`, 0 and up, of the layer: points that fall independently of each other (a Poisson
   process), so that a piece whose image is a pixel gets one with the layer's opacity whatever the sizes of
   triangles. The same for the same seed, set and layer. Returns how many were projected. */
size_t layer_project(const Layer *layer, uint64_t seed, uint64_t set, const SetSight *sight,
                     const SetImage *image);

#endif
