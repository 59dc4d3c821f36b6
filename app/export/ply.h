/* Particles as a point cloud, or the fluid's surface as a mesh: PLY, binary little endian, for Blender,
   MeshLab, CloudCompare and scripts.

   One element `vertex` with the properties x y z (m), vx vy vz (m/s), density (kg/m3), pressure (Pa): float;
   fluid: int; id: uint, since PLY has no integer of 64 bits; and red green blue: uchar, sRGB, of the fluid
   where its colour is known, or of a scalar by a colormap. A surface has its normal, nx ny nz, behind x y z,
   and no id; then the element `face` with vertex_indices, a list of int. */
#ifndef SLOSH_PLY_H
#define SLOSH_PLY_H

#include "app/export/surface.h"
#include "app/output/snapshot.h"
#include "sim/base/scalar.h"

#include <stdio.h>

/* What the points are coloured by: their fluid, or a scalar. */
typedef struct PlyColors {
    size_t count;                /* fluids that have a colour; 0: none are written */
    double color[FLUIDS_MAX][3]; /* sRGB 0 to 1 */
    bool mapped;                 /* by the scalar instead: speed, density or pressure */
    Scalar scalar;
    double low, high; /* values of the first and the last colour of the default colormap */
} PlyColors;

/* The speed (m/s), density (kg/m3) or pressure (Pa) of point i. */
double ply_scalar(const SnapshotStep *step, size_t i, Scalar scalar);

/* Whether PLY can hold the step; false with the reason: an id of more than 32 bits. */
bool ply_check(const SnapshotStep *step, Error *error);

/* `frame` and the step's time go into a comment, and so does what a colormap is of. A fluid that has no
   colour among others that have is grey. False when the stream fails (errno tells why). */
bool ply_write(FILE *file, const SnapshotStep *step, const char *frame, const PlyColors *colors);
bool ply_write_surface(FILE *file, const Surface *surface, const char *frame, const PlyColors *colors);

#endif
