/* Meshes as Wavefront OBJ, for Blender, Houdini and further programs: text, any number of named meshes per
   file.

   Each mesh begins with `o NAME` and `g NAME`, as programs read either objects or groups. Vertices are `v
   x y z`, m, followed by red green blue if coloured (sRGB 0 to 1, like in Blender); normals `vn`;
   triangles `f`, counter-clockwise seen from outside. y is up. Numbers have all bits of the snapshot. The
   head has time, frame and units. */
#ifndef SLOSH_OBJ_H
#define SLOSH_OBJ_H

#include "app/export/point_color.h"
#include "app/export/surface.h"

#include <stdio.h>

/* A file being written. */
typedef struct ObjFile {
    FILE *file;
    size_t vertices; /* written so far: faces count from the file's first vertex */
} ObjFile;

/* Writes the head, with time (s), `frame`, and the meaning of a colormap. */
ObjFile obj_begin(FILE *file, double time, const char *frame, const PointColors *colors);

/* Adds a mesh. Blanks and control characters in the name become '_'. */
void obj_add(ObjFile *obj, const char *name, const Surface *mesh, const PointColors *colors);

/* Returns false if the stream failed (see errno). */
bool obj_end(const ObjFile *obj);

#endif
