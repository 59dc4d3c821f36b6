/* What a solid of uniform density weighs and how hard it is to turn: integrals over its volume; in two
   dimensions of a metre's depth. */
#ifndef SLOSH_BODY_MASS_H
#define SLOSH_BODY_MASS_H

#include "sim/matter/solid.h"

typedef struct BodyMass {
    double volume;     /* m3 */
    double mass;       /* kg */
    double centre[3];  /* of mass, in the solid's frame, m */
    double inertia[3]; /* about it, along its principal axes, kg m2; in two dimensions all are that about z */
    double axes[4];    /* unit quaternion: the solid's frame = axes * principal axes */
    double broad; /* volume of fluid that a plate of the body's greatest extent takes along at least, m3 */
    double area;  /* of the block that has the body's inertia, m2 */
} BodyMass;

/* Of a solid with density > 0. A mesh: sums of exact integrals over the tetrahedra from the origin to its
   triangles, which the divergence theorem makes the integral over what it encloses (Mirtich, "Fast and
   accurate computation of polyhedral mass properties", 1996); where parts overlap, less the excess of the
   shape, within some thousandths of the excess. */
void body_mass(const SolidDef *solid, int dimensions, BodyMass *mass);

#endif
