/* Vertices at the same place become a single vertex. */
#ifndef SLOSH_WELD_H
#define SLOSH_WELD_H

#include "sim/mesh/triangles.h"

/* Joins each vertex to the first vertex no farther away than `part` of the longest side of the block around
   all; a vertex between two vertices farther apart follows the first of both. Vertices that stay keep order
   and bits. False when memory is short. */
bool weld_vertices(Triangles *triangles, double part);

#endif
