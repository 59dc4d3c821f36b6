/* Finds the bricks of a volume that may hold fluid to draw, and the faces between these bricks and all
   others: rays enter and leave there and skip the empty rest.

   A brick stores the largest value of the field inside, by linear interpolation: over its voxels and the
   voxels that it shares with neighbours at its faces. After: Krüger and Westermann, Acceleration
   techniques for GPU-based volume rendering, 2003 (empty-space skipping). */
#ifndef SLOSH_BRICKS_H
#define SLOSH_BRICKS_H

#include "render/particles/particle_bind.h"
#include "render/volume/volume.h"
#include "sim/base/error.h"

/* Least side of a brick, cells; largest number of bricks along a side of the volume. */
enum { BRICK_CELLS = 8, BRICKS_ALONG = 64 };

typedef struct Bricks {
    unsigned greatest, list, faces; /* programs */
    unsigned map;                   /* GL_TEXTURE_3D, R32F, a texel per brick */
    unsigned found, commands;       /* buffers: the faces; a drawing command */
    QuadIndices quads;
    int size[3];     /* bricks */
    size_t capacity; /* faces */
} Bricks;

/* Returns false if a shader does not compile; call bricks_destroy in either case. */
bool bricks_create(Bricks *bricks, Error *error);
void bricks_destroy(Bricks *bricks);

/* Fills the map from the volume, and lists the faces of bricks above the threshold in the uniform block of
   shaders/volume/raycast.glsl. Bind this block first, and the field to texture unit 8. */
void bricks_make(Bricks *bricks, const Volume *volume);

/* Returns the side of a grid's bricks in cells; `count`: bricks along each axis. */
int bricks_of(const VolumeGrid *grid, int count[3]);

/* Draws the faces, depth only; counter-clockwise seen from outside. */
void bricks_draw_faces(Bricks *bricks);

#endif
