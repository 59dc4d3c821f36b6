/* Where a body may touch something: points of its surface, each a ball of its own radius. */
#ifndef SLOSH_BODY_HULL_H
#define SLOSH_BODY_HULL_H

#include "sim/matter/solid.h"

enum { BODY_POINTS = 160 };

typedef struct BodyHull {
    int count;
    double point[BODY_POINTS][3]; /* the solid's frame, m */
    double radius;                /* of each, m: that of a ball, which is one point; else 0 */
} BodyHull;

/* Corners and points of the edges of a box; rims; of a bowl its outside too; of a mesh the vertices that
   stand out most in many directions. */
void body_hull(const SolidDef *solid, int dimensions, BodyHull *hull);

#endif
