/* Particles as a point cloud, or the fluid's surface as a mesh: PLY, binary little endian, for Blender,
   MeshLab, CloudCompare and scripts.

   One element `vertex` with the float properties x y z (m), vx vy vz (m/s), density (kg/m3), pressure
   (Pa); fluid: int; id: uint, as PLY has no 64-bit integers; and red green blue: uchar, sRGB, the fluid's
   colour if known, or a scalar's colour from a colormap. A surface has its normal, nx ny nz, after x y z,
   and no id; then the element `face` with vertex_indices, a list of int. */
#ifndef SLOSH_PLY_H
#define SLOSH_PLY_H

#include "app/export/point_color.h"
#include "app/export/surface.h"

#include <stdio.h>

/* Returns true if PLY can hold the step; false with the reason: an id of more than 32 bits. */
bool ply_check(const SnapshotStep *step, Error *error);

/* Writes a file; comments have `frame`, the step's time and the meaning of a colormap. If only some fluids
   have colours, the rest are grey. Returns false if the stream fails (see errno). */
bool ply_write(FILE *file, const SnapshotStep *step, const char *frame, const PointColors *colors);
bool ply_write_surface(FILE *file, const Surface *surface, const char *frame, const PointColors *colors);

#endif
