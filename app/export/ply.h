/* Particles as a point cloud, or the fluid's surface as a mesh: PLY, binary little endian, for Blender,
   MeshLab, CloudCompare and scripts.

   One element `vertex` with the properties x y z (m), vx vy vz (m/s), density (kg/m3), pressure (Pa): float;
   fluid: int; id: uint, since PLY has no integer of 64 bits; and red green blue: uchar, sRGB, of the fluid
   where its colour is known, or of a scalar by a colormap. A surface has its normal, nx ny nz, behind x y z,
   and no id; then the element `face` with vertex_indices, a list of int. */
#ifndef SLOSH_PLY_H
#define SLOSH_PLY_H

#include "app/export/point_color.h"
#include "app/export/surface.h"

#include <stdio.h>

/* Whether PLY can hold the step; false with the reason: an id of more than 32 bits. */
bool ply_check(const SnapshotStep *step, Error *error);

/* `frame` and the step's time go into a comment, and so does what a colormap is of. A fluid that has no
   colour among others that have is grey. False when the stream fails (errno tells why). */
bool ply_write(FILE *file, const SnapshotStep *step, const char *frame, const PointColors *colors);
bool ply_write_surface(FILE *file, const Surface *surface, const char *frame, const PointColors *colors);

#endif
