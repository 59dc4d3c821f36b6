/* Where bodies touch walls, other solids and each other.

   A contact is a point of a body's hull within what it may come nearer in a step to a wall, or to the signed
   distance of another solid; or a point of the hull of a solid that does not float, so near to a body's.
   Blows along its normal keep the point from going deeper than the surface by the end of the step; what comes
   faster than a fall over a spacing bounces with BODY_BOUNCE of its speed; friction is Coulomb's, with
   BODY_FRICTION. Both are of no material: wood on wood. Blows are found contact by contact, a fixed number of
   times in a fixed order (Catto, "Iterative dynamics with temporal coherence", 2005), so that their bits
   depend on nothing else. What is left of overlaps at the end of a step is moved apart, without velocity; on
   a hinge it stays. */
#ifndef SLOSH_BODY_CONTACT_H
#define SLOSH_BODY_CONTACT_H

#include "sim/body/body.h"
#include "sim/box/wall.h"

#define BODY_BOUNCE   0.3
#define BODY_FRICTION 0.3

/* All that may touch, by the def's solids. */
typedef struct BodyWorld {
    int dimensions, count; /* solids */
    const Walls *walls;
    const SolidDef *solids;
    const Body *bodies;      /* of those that are free; of the others their hulls alone */
    const BoxState *fixed;   /* poses of those that are not */
    double gravity, spacing; /* amount, m/s2; m: what is slow enough not to bounce */
} BodyWorld;

/* Blows for a step of dt, s. */
void body_contacts_hit(const BodyWorld *world, double dt, BodyStates *states);

/* What a body overlaps with most. */
typedef struct BodyOverlap {
    int other;    /* a solid, or BODY_AT_WALL */
    double depth; /* m */
    bool fits;    /* it does not stick out of the box on two sides */
} BodyOverlap;

enum { BODY_AT_WALL = -1 };

/* The deepest overlap of one body by more than `least`, m; false: there is none. */
bool body_overlap(const BodyWorld *world, const BodyStates *states, int body, double least,
                  BodyOverlap *overlap);

/* Moves apart what overlaps; returns the way of what moved furthest, m. */
double body_contacts_part(const BodyWorld *world, BodyStates *states);

#endif
