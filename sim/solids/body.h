/* Mass and inertia of a solid of uniform density: integrals over the volume; in two dimensions for a depth of
   1 m. */
#ifndef SIM_SOLIDS_BODY_H
#define SIM_SOLIDS_BODY_H

#include "sim/box/box_step.h"
#include "sim/box/walls.h"
#include "slosh/def.h"
#include "slosh/state.h"

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

/* Hull of a body for contacts: surface points, each with a radius. */

enum { BODY_POINTS = 160 };

typedef struct BodyHull {
    int count;
    double point[BODY_POINTS][3]; /* the solid's frame, m */
    double radius; /* of each point, m: the radius of a ball, which is a single point; else 0 */
} BodyHull;

/* Makes the hull. Box: corners and edge points; cylinder: rims; bowl: rim and outside; mesh: outermost
   vertices in many directions; ball: the centre. */
void body_hull(const SolidDef *solid, int dimensions, BodyHull *hull);

/* Solids moved by the fluid (SolidDef.density): rigid bodies, free or on a hinge fixed to the box.

   Between two poses of the box, a free body flies straight in the world, as fluid particles do
   (sim/box/box_step.h): the effect of the box's motion is exact, without apparent forces. Rotation uses the
   splitting of Dullweber, Leimkuhler and McLachlan ("Symplectic splitting methods for rigid body molecular
   dynamics", 1997): a sequence of exact turns about the principal axes. The splitting is symplectic and keeps
   the angular momentum to the last digit.

   The force of the fluid (F) and the acceleration depend on each other: within the next step the fluid pushes
   a faster body back, by the mass of fluid carried along. An explicit step diverges if the carried mass
   exceeds the body's mass, for any time step. So the acceleration by fluid is

       a = (F + M a_before) / (m + M)

   A constant a stays the same, and the form is stable for all bodies with a carried mass up to m + 2 M. M is
   the least sufficient mass. Where pressure holds the density within a step: the mass of fluid in the body's
   volume, or more for flat bodies (BodyMass.broad). Where sound carries pressure, and crosses only a part of
   a support radius in a step: the resistance on the way, rho area (c dt)^2 / h, less m. M counts in full if F
   is at least a quarter of the buoyancy of the whole body, and in proportion below: M vanishes in the air. */

typedef struct Body {
    SolidDef def;
    BodyMass mass;
    BodyHull hull;
    bool hinged;
    double at[3], axis[3]; /* hinge: a point and the unit direction, in the box's frame */
    double arm[3];         /* the hinge's point in the solid's frame, m */
    double about;          /* inertia about the hinge, kg m2 */
} Body;

void body_make(Body *body, const SolidDef *solid, int dimensions);

/* Sets the start state: in place, at rest in the box, and borne by fluid against `gravity` (m/s2, in the
   box's axes). A body without fluid around loses the support in the first step. */
void body_start(const Body *body, const double gravity[3], BodyState *state);

/* Free flight over dt (s) from one pose of the box to another. */
void body_drift(const Body *body, const BoxState *begin, const BoxState *end, double dt, BodyState *state);

/* The fluid around a body, for M. */
typedef struct BodyFluid {
    double density; /* of the heaviest fluid, kg/m3 */
    double sound;   /* m/s; 0: pressure holds the density within a step */
    double reach;   /* h, m */
    double gravity; /* amount, m/s2 */
} BodyFluid;

/* Applies the fluid's push in a step of dt (s), and the push in state->left. `push`: N s, N m s about the
   pose's position, without `left`. */
void body_push(const Body *body, const BodyFluid *fluid, const Push *push, double dt, BodyState *state);

/* Applies gravity (m/s2, in the box's axes) over dt (s). A hinged body, carried by the box, gets `apparent`
   instead: gravity and the box's motion. */
void body_fall(const Body *body, const double gravity[3], const ApparentGravity *apparent, double dt,
               BodyState *state);

/* Rates of change of the frame's velocity (m/s2) and angular velocity (rad/s2), with the fluid's push of the
   last step. */
void body_rates(const Body *body, const ApparentGravity *apparent, const BodyState *state, double change[3],
                double alpha[3]);

/* Adds the body's energy, mass, position and momenta. */
void body_sums(const Body *body, const BodyState *state, EnergySums *sums);

/* Velocity of the body's matter at x, box's frame. */
void body_velocity(const BoxState *pose, const double x[3], double v[3]);

/* Centre of mass, box's frame, m. */
void body_centre(const Body *body, const BodyState *state, double centre[3]);

/* Applies an impulse at x, N s: changes the body's velocities. */
void body_hit(const Body *body, const double x[3], const double blow[3], BodyState *state);

/* Speed of the body's matter at x along the unit vector n, gained by an impulse of 1 N s along n at x:
   1/kg. */
double body_yield(const Body *body, const BodyState *state, const double x[3], const double n[3]);

/* Contacts of bodies with walls, other solids and each other.

   A contact is a hull point of a body near a wall, or near another solid by signed distance. A hull point of
   a fixed solid near a body is a contact as well. Near: within the possible approach in a step. Impulses
   along the normal keep the point from going deeper than the surface by the end of the step. Points faster
   than a fall over a spacing bounce with BODY_BOUNCE of the speed. Friction is Coulomb's, with BODY_FRICTION.
   Both constants are for wood on wood, whatever the material. Impulses are found contact by contact, a fixed
   number of times in a fixed order (Catto, "Iterative dynamics with temporal coherence", 2005): the bits
   depend on nothing else. Overlaps left at the end of a step are moved apart, without velocity; hinged bodies
   stay. */

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
