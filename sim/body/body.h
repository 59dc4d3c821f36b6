/* Solids that move by the fluid (SolidDef.density): rigid bodies, free or on a hinge that is fixed to the
   box.

   A free body's flight between two poses of the box is its straight flight in the world, seen from them, as
   that of fluid particles (sim/box/box_step.h): what the box's motion is for it is exact, and nothing of it
   is a force. Its turning is the splitting of Dullweber, Leimkuhler and McLachlan ("Symplectic splitting
   methods for rigid body molecular dynamics", 1997): turns about its principal axes, one after the other, of
   which each is exact. It is symplectic and keeps the angular momentum to the last digit.

   Force of the fluid (F) and acceleration are tied to each other: what a body is faster, the fluid pushes
   back within the next step, by the mass that it takes along. Taken as it comes, that diverges where this
   mass is more than the body's own, whatever the step. So the acceleration by fluid is

       a = (F + M a_before) / (m + M)

   the same where a does not change, and stable for all bodies that take up to m + 2 M along. M is the least
   that does: where pressure holds the density within a step, the mass of fluid in the body's volume, or more
   for flat bodies (BodyMass.broad); where sound carries pressure, which in a step goes a part of a support
   radius far, what resists on the way: rho area (c dt)^2 / h, less m. It counts in full where F is a quarter
   of the buoyancy of the whole body, and in proportion below, so that none is left in the air. */
#ifndef SLOSH_BODY_H
#define SLOSH_BODY_H

#include "sim/body/body_hull.h"
#include "sim/body/body_mass.h"
#include "sim/body/body_state.h"
#include "sim/box/box_step.h"
#include "sim/matter/energy_sums.h"

typedef struct Body {
    SolidDef def;
    BodyMass mass;
    BodyHull hull;
    bool hinged;
    double at[3], axis[3]; /* of the hinge: a point, the unit direction; the box's frame */
    double arm[3];         /* the hinge's point in the solid's frame, m */
    double about;          /* inertia about the hinge, kg m2 */
} Body;

void body_make(Body *body, const SolidDef *solid, int dimensions);

/* As the scene has it: in its place, at rest in the box, and borne by what is around it, if that is fluid,
   against `gravity` (m/s2, in the box's axes): what no fluid reaches forgets that in its first step. */
void body_start(const Body *body, const double gravity[3], BodyState *state);

/* Free flight over dt (s) from one pose of the box to another. */
void body_drift(const Body *body, const BoxState *begin, const BoxState *end, double dt, BodyState *state);

/* What is around a body, for M. */
typedef struct BodyFluid {
    double density; /* of the heaviest fluid, kg/m3 */
    double sound;   /* m/s; 0: it holds its density within a step */
    double reach;   /* h, m */
    double gravity; /* amount, m/s2 */
} BodyFluid;

/* What fluid does to it in a step of dt (s): N s, N m s about the pose's position, without what is `left`. */
void body_push(const Body *body, const BodyFluid *fluid, const Push *push, double dt, BodyState *state);

/* Gravity over dt, m/s2, in the box's axes; for a body on a hinge, which the box takes along, what the box's
   motion is for it too. */
void body_fall(const Body *body, const double gravity[3], const ApparentGravity *apparent, double dt,
               BodyState *state);

/* How its frame's velocity and turning change, m/s2 and rad/s2, by what is known of the step before. */
void body_rates(const Body *body, const ApparentGravity *apparent, const BodyState *state, double change[3],
                double alpha[3]);

/* Adds what it has of energy, mass, places and momenta. */
void body_sums(const Body *body, const BodyState *state, EnergySums *sums);

/* Velocity of the body's matter at x, box's frame. */
void body_velocity(const BoxState *pose, const double x[3], double v[3]);

/* Centre of mass, box's frame, m. */
void body_centre(const Body *body, const BodyState *state, double centre[3]);

/* A blow at x, N s: changes its velocities. */
void body_hit(const Body *body, const double x[3], const double blow[3], BodyState *state);

/* How much faster its matter at x gets along the unit vector n by a blow of 1 N s along n there, 1/kg. */
double body_yield(const Body *body, const BodyState *state, const double x[3], const double n[3]);

#endif
