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

#endif
