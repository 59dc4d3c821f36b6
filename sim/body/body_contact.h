/* Contacts of bodies with walls, other solids and each other.

   A contact is a hull point of a body near a wall, or near another solid by signed distance. A hull point of
   a fixed solid near a body is a contact as well. Near: within the possible approach in a step. Impulses
   along the normal keep the point from going deeper than the surface by the end of the step. Points faster
   than a fall over a spacing bounce with BODY_BOUNCE of the speed. Friction is Coulomb's, with BODY_FRICTION.
   Both constants are for wood on wood, whatever the material. Impulses are found contact by contact, a fixed
   number of times in a fixed order (Catto, "Iterative dynamics with temporal coherence", 2005): the bits
   depend on nothing else. Overlaps left at the end of a step are moved apart, without velocity; hinged bodies
   stay. */
#ifndef SLOSH_BODY_CONTACT_H
#define SLOSH_BODY_CONTACT_H

#include "sim/body/body.h"
#include "sim/box/wall.h"

#define BODY_BOUNCE   0.3
#define BODY_FRICTION 0.3

/* Walls and solids; arrays are indexed as the def's solids. */
typedef struct BodyWorld {
    int dimensions, count; /* solids */
    const Walls *walls;
    const SolidDef *solids;
    const Body *bodies;      /* complete for free solids; only the hull for fixed solids */
    const BoxState *fixed;   /* poses of the fixed solids */
    double gravity, spacing; /* m/s2; m: both set the least speed with a bounce */
} BodyWorld;

/* Applies the contact impulses of a step of dt, s. */
void body_contacts_hit(const BodyWorld *world, double dt, BodyStates *states);

/* The deepest overlap of a body. */
typedef struct BodyOverlap {
    int other;    /* a solid, or BODY_AT_WALL */
    double depth; /* m */
    bool fits;    /* false: sticks out of the box on two opposite sides */
} BodyOverlap;

enum { BODY_AT_WALL = -1 };

/* Finds the deepest overlap of a body by more than `least`, m. Returns false without such an overlap. */
bool body_overlap(const BodyWorld *world, const BodyStates *states, int body, double least,
                  BodyOverlap *overlap);

/* Moves overlapping solids apart; returns the depth of the deepest overlap moved, m. */
double body_contacts_part(const BodyWorld *world, BodyStates *states);

#endif
