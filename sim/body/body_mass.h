/* Mass and inertia of a solid of uniform density: integrals over the volume; in two dimensions for a depth of
   1 m. */
#ifndef SLOSH_BODY_MASS_H
#define SLOSH_BODY_MASS_H

#include "sim/matter/solid.h"

typedef struct BodyMass {
    double volume;     /* m3 */
    double mass;       /* kg */
    double centre[3];  /* of mass, in the solid's frame, m */
    double inertia[3]; /* about the centre of mass, along the principal axes, kg m2; in two dimensions all
                          three are the inertia about z */
    double axes[4];    /* unit quaternion: the solid's frame = axes * principal axes */
    double broad;      /* least volume of fluid carried by a plate of the body's greatest extent, m3 */
    double area;       /* surface of the block with the body's inertia, m2 */
} BodyMass;

/* Computes the mass of a solid with density > 0. Mesh: sums exact integrals over the tetrahedra from the
   origin to the triangles; by the divergence theorem the sum is the integral over the enclosed volume. After:
   Mirtich, "Fast and accurate computation of polyhedral mass properties", 1996. Where parts overlap, less the
   excess of the shape: within some thousandths of the excess. */
void body_mass(const SolidDef *solid, int dimensions, BodyMass *mass);

#endif
