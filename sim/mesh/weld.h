/* Vertices of one place become one. */
#ifndef SLOSH_WELD_H
#define SLOSH_WELD_H

#include "sim/mesh/triangles.h"

/* Joins each vertex to the first one that is no farther from it than `part` of the longest side of the block
   around all of them; vertices in between, near two that are not near each other, follow the first of both.
   The vertices that stay keep their order and their bits. False when memory is short. */
bool weld_vertices(Triangles *triangles, double part);

#endif
