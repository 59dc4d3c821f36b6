/* The colours of a mesh's vertices and of points in files that have any: of their fluids, or of a scalar by a
   colormap. */
#ifndef SLOSH_POINT_COLOR_H
#define SLOSH_POINT_COLOR_H

#include "app/output/snapshot.h"
#include "render/frame/colormap.h"
#include "sim/base/scalar.h"

#include <stdio.h>

/* What the points are coloured by: their fluid, or a scalar. */
typedef struct PointColors {
    size_t count;                /* fluids that have a colour; 0: none are written */
    double color[FLUIDS_MAX][3]; /* sRGB 0 to 1 */
    bool mapped;                 /* by the scalar instead: speed, density or pressure */
    Scalar scalar;
    double low, high; /* values of the first and the last colour of the default colormap */
} PointColors;

/* Whether points have a colour at all. */
bool point_colored(const PointColors *colors);

/* The speed (m/s), density (kg/m3) or pressure (Pa) of point i. */
double point_scalar(const SnapshotStep *step, size_t i, Scalar scalar);

/* What a file says of a colormap in a line of its head, "colours: ..."; nothing where fluids are shown. */
void point_colors_print(FILE *file, const char *before, const PointColors *colors);

/* Gives points their colours. */
typedef struct PointPainter {
    const PointColors *colors; /* not owned */
    uint8_t map[3 * COLORMAP_SIZE];
} PointPainter;

PointPainter point_painter(const PointColors *colors);

/* sRGB of point i. A fluid that has no colour is grey. */
void point_paint(const PointPainter *painter, const SnapshotStep *step, size_t i, uint8_t rgb[3]);

#endif
