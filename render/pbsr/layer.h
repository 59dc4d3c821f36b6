/* The pieces of a layer of the view pbsr, triangles or cells of a volume, and random points on the pieces. */
#ifndef SLOSH_LAYER_H
#define SLOSH_LAYER_H

#include "render/pbsr/set_image.h"

#include <stdbool.h>

/* The expected number of points of one set on a visible triangle or in a visible cell. */
typedef struct LayerShare {
    float expected; /* number if the whole piece were at depth w = nearest */
    float nearest;  /* m; a point at depth w is kept with the probability (nearest / w)^2 */
} LayerShare;

/* Zero-initialise. Owns its arrays. */
typedef struct Layer {
    size_t point_count, triangle_count; /* without triangles, points are centres of cells */
    size_t point_capacity, triangle_capacity, share_capacity;
    LayerPoint *point;
    uint32_t (*triangle)[3];
    LayerShare *share; /* one per triangle or cell */
    double cell[3];    /* sides of a cell, m */
    bool slab;         /* a single layer of cells, as deep as the cell along z, with constant density along
                          z */
    double density;    /* points of a set per surface area that a pixel shows; for cells: per m */
    unsigned number;   /* 0 .. 15 */
    double curved;     /* 0 and up: relative number of extra points where a surface is curved */
    double support;    /* m: the extra points are full up to this radius of curvature, and inversely
                          proportional to larger radii */
    double beyond;     /* for the last sight: needed points divided by drawn points on the largest piece;
                          up to 1: no piece is too large */
} Layer;

/* Makes room for points and triangles; old contents are lost. Returns false if memory is short. */
bool layer_reserve(Layer *layer, size_t points, size_t triangles);
void layer_free(Layer *layer); /* a zeroed struct is allowed */

/* Computes the shares for a sight; the same bits for any number of threads. Returns false if memory is
   short. */
bool layer_share(Layer *layer, const SetSight *sight);

/* Drawn points divided by the points that the opacity needs, on the largest piece; at most 1. */
double layer_part(const Layer *layer);

/* Projects set number `set`, 0 and up: independent random points (a Poisson process), so that a piece with
   an image of one pixel gets the layer's opacity, whatever the sizes of triangles. The result depends only
   on seed, set and layer. Returns the number of projected points. */
size_t layer_project(const Layer *layer, uint64_t seed, uint64_t set, const SetSight *sight,
                     const SetImage *image);

#endif
