/* Meshes as Wavefront OBJ, for Blender, Houdini and whatever else reads meshes: text, any number of named
   meshes in a file.

   Each begins with `o NAME` and `g NAME`, an object for one reader and a group for another; its vertices are
   `v x y z`, m, and behind them red green blue where they have a colour (sRGB 0 to 1, as Blender takes them),
   their normals `vn`, and its triangles `f`, counter-clockwise seen from outside. y is up. Numbers are those
   of the snapshot to the last bit. The head has time, frame and units. */
#ifndef SLOSH_OBJ_H
#define SLOSH_OBJ_H

#include "app/export/point_color.h"
#include "app/export/surface.h"

#include <stdio.h>

/* A file in the making. */
typedef struct ObjFile {
    FILE *file;
    size_t vertices; /* that are in it: faces count from the file's first */
} ObjFile;

/* `frame` and the time, s, go into the head, and so does what a colormap is of. */
ObjFile obj_begin(FILE *file, double time, const char *frame, const PointColors *colors);

/* A blank or a letter of control in the name becomes '_'. */
void obj_add(ObjFile *obj, const char *name, const Surface *mesh, const PointColors *colors);

/* False when the stream failed (errno tells why). */
bool obj_end(const ObjFile *obj);

#endif
