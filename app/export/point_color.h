/* Colours of mesh vertices and points in files: by fluid, or by a scalar with a colormap. */
#ifndef SLOSH_POINT_COLOR_H
#define SLOSH_POINT_COLOR_H

#include "app/output/snapshot.h"
#include "render/frame/colormap.h"
#include "sim/base/scalar.h"

#include <stdio.h>

/* Source of the colours: fluid or scalar. */
typedef struct PointColors {
    size_t count;                /* fluids with a colour; 0: no colours are written */
    double color[FLUIDS_MAX][3]; /* sRGB 0 to 1 */
    bool mapped;                 /* by scalar: speed, density or pressure */
    Scalar scalar;
    double low, high; /* values of the first and the last colour of the default colormap */
} PointColors;

/* True if points have a colour. */
bool point_colored(const PointColors *colors);

/* Returns the speed (m/s), density (kg/m3) or pressure (Pa) of point i. */
double point_scalar(const SnapshotStep *step, size_t i, Scalar scalar);

/* Prints the meaning of a colormap as a head line, "colours: ..."; nothing for colours by fluid. */
void point_colors_print(FILE *file, const char *before, const PointColors *colors);

/* Computes colours of points. */
typedef struct PointPainter {
    const PointColors *colors; /* not owned */
    uint8_t map[3 * COLORMAP_SIZE];
} PointPainter;

PointPainter point_painter(const PointColors *colors);

/* Fills in the sRGB colour of point i. A fluid without colour is grey. */
void point_paint(const PointPainter *painter, const SnapshotStep *step, size_t i, uint8_t rgb[3]);

#endif
