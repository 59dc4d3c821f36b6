/* Boundary particles: what fluid sees of solids. They stand in layers behind a solid's surface, the first
   half a spacing away, down to the support radius, each for a volume of spacing^dimensions; the sums over
   neighbours take them for particles of a lattice at rest (Akinci 2012; Adami 2012). Layers follow the
   surface, so that a sphere is as smooth as its particles allow. */
#ifndef SLOSH_BOUNDARY_H
#define SLOSH_BOUNDARY_H

#include "sim/matter/world_def.h"

typedef struct Boundary {
    size_t count;
    float *rest;    /* 3 a particle: in its solid's frame, m */
    uint8_t *solid; /* of a particle: index into WorldDef.solids */
} Boundary;

/* Of all solids of the def; without solids nothing is allocated. False when memory is short. */
bool boundary_create(Boundary *boundary, const WorldDef *def);
void boundary_destroy(Boundary *boundary);

/* The layers of one solid that is no mesh, up to `depth` m behind the surface: writes 3 floats a particle, in
   the solid's frame, and returns how many there are; with NULL it only counts. In two dimensions all have z =
   0. */
size_t boundary_layers(const SolidDef *solid, int dimensions, double spacing, double depth, float *position);

/* About as many, without making them. */
double boundary_estimate(const SolidDef *solid, int dimensions, double spacing, double depth);

#endif
