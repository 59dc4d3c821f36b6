/* Which bricks of a volume may hold what is looked for, and the faces between those that do and those that do
   not: where rays enter and leave what is worth marching through.

   A brick has the greatest value of the field in it, by linear interpolation: that of its voxels and of those
   that neighbours share with it, at its faces. After: Krüger and Westermann, Acceleration techniques for
   GPU-based volume rendering, 2003 (empty-space skipping). */
#ifndef SLOSH_BRICKS_H
#define SLOSH_BRICKS_H

#include "render/particles/particle_bind.h"
#include "render/volume/volume.h"
#include "sim/base/error.h"

/* A side of a brick at least, cells; bricks along a side of the volume at most. */
enum { BRICK_CELLS = 8, BRICKS_ALONG = 64 };

typedef struct Bricks {
    unsigned greatest, list, faces; /* programs */
    unsigned map;                   /* GL_TEXTURE_3D, R32F, a texel a brick */
    unsigned found, commands;       /* buffers: faces found, a command to draw them */
    QuadIndices quads;
    int size[3];     /* bricks */
    size_t capacity; /* faces */
} Bricks;

/* False when a shader does not compile; bricks_destroy is needed in either case. */
bool bricks_create(Bricks *bricks, Error *error);
void bricks_destroy(Bricks *bricks);

/* Fills the map from the volume, and lists the faces of bricks that exceed what the uniform block of
   shaders/volume/raycast.glsl says. That must be bound, and the field to texture unit 8. */
void bricks_make(Bricks *bricks, const Volume *volume);

/* The side of a grid's bricks in cells, and their number along each axis. */
int bricks_of(const VolumeGrid *grid, int count[3]);

/* Draws the faces, depth only: counter-clockwise from outside. */
void bricks_draw_faces(Bricks *bricks);

#endif
