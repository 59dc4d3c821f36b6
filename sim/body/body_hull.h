/* Hull of a body for contacts: surface points, each with a radius. */
#ifndef SLOSH_BODY_HULL_H
#define SLOSH_BODY_HULL_H

#include "sim/matter/solid.h"

enum { BODY_POINTS = 160 };

typedef struct BodyHull {
    int count;
    double point[BODY_POINTS][3]; /* the solid's frame, m */
    double radius; /* of each point, m: the radius of a ball, which is a single point; else 0 */
} BodyHull;

/* Makes the hull. Box: corners and edge points; cylinder: rims; bowl: rim and outside; mesh: outermost
   vertices in many directions; ball: the centre. */
void body_hull(const SolidDef *solid, int dimensions, BodyHull *hull);

#endif
