/* Boundary particles: how fluid sees solids. Layers of particles lie behind a solid's surface, the first half
   a spacing away, down to the support radius; each particle has a volume of spacing^dimensions. Sums over
   neighbours treat boundary particles like particles of a lattice at rest (Akinci 2012; Adami 2012). Layers
   follow the surface, so that a sphere is as smooth as its particles allow. */
#ifndef SLOSH_BOUNDARY_H
#define SLOSH_BOUNDARY_H

#include "sim/matter/world_def.h"

typedef struct Boundary {
    size_t count;
    float *rest;    /* 3 per particle: in the solid's frame, m */
    uint8_t *solid; /* per particle: index into WorldDef.solids */
} Boundary;

/* Creates the boundary particles of all solids of the def; without solids nothing is allocated. Returns false
   if memory is short. */
bool boundary_create(Boundary *boundary, const WorldDef *def);
void boundary_destroy(Boundary *boundary);

/* The layers of one solid, not a mesh, up to `depth` m behind the surface: writes 3 floats per particle, in
   the solid's frame, m, and returns the number of particles. With NULL only counts. In two dimensions all
   have z = 0. */
size_t boundary_layers(const SolidDef *solid, int dimensions, double spacing, double depth, float *position);

/* Estimates the number of particles without making them; meshes too. */
double boundary_estimate(const SolidDef *solid, int dimensions, double spacing, double depth);

#endif
