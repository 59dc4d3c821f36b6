/* Vertices at the same place become a single vertex. */
#ifndef SLOSH_WELD_H
#define SLOSH_WELD_H

#include "sim/mesh/triangles.h"

/* Joins each vertex to the first kept vertex within `part` of the bounding box's longest side, and renumbers
   the triangles. A vertex between two kept vertices joins the first of both. Kept vertices keep order and
   bits. Returns false if memory is short. */
bool weld_vertices(Triangles *triangles, double part);

#endif
