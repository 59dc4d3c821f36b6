/* Solids: fixed and driven solids over a step, boundary particles, and rigid bodies moved by the fluid,
   with contacts. */
#ifndef SIM_SOLIDS_SOLID_H
#define SIM_SOLIDS_SOLID_H

#include "sim/box/box.h"
#include "sim/def.h"
#include "sim/error.h"
#include "sim/state.h"

#include <stddef.h>

/* Solids over a step: positions, velocities and accelerations of boundary particles, and the guard against
   fluid inside. */

/* A pose in single precision: x_box = x + r x_solid; the velocity at x_box is v + w x (x_box - x). */
typedef struct SolidPose {
    float x[3]; /* m */
    float r[3][3];
    float v[3]; /* m/s */
    float w[3]; /* rad/s */
} SolidPose;

/* Motion of one solid from one pose to the next. */
typedef struct SolidStep {
    SolidPose begin, end;
    bool still; /* no motion: the whole solid lies between `low` and `high` in the box's frame, m */
    float low[3], high[3];
    float change[3]; /* of v, over the step: m/s2 */
    float alpha[3];  /* of w, over the step: rad/s2 */
} SolidStep;

/* The pose at `time` (s); of a floating solid where the solid began. */
void solid_pose_at(const SolidDef *solid, double time, SolidPose *pose);
/* The same pose in single precision. */
void solid_pose_of(const BoxState *at, SolidPose *pose);

/* The solid's step from `begin` to `end`, s. */
void solid_step_make(const SolidDef *solid, double begin, double end, SolidStep *step);

/* The step of a solid at rest at `pose`. */
void solid_step_stand(const SolidDef *solid, const SolidPose *pose, SolidStep *step);

/* Gives both halves of a step the rates of the whole step. */
void solid_step_mean(SolidStep *first, SolidStep *second);

/* Positions, m, from the solid's frame to the box's frame and back. */
void solid_to_box(const SolidPose *pose, const float in_solid[3], float x[3]);
void solid_from_box(const SolidPose *pose, const float x[3], float in_solid[3]);

/* Signed distance of x from the surface, m; further away than `far`: a lower bound of at least `far`. */
float solid_clearance(const SolidDef *solid, const SolidPose *pose, int dimensions, const float x[3],
                      float far);

/* Velocity of the solid's matter at x (box's frame, m), m/s. */
void solid_velocity_at(const SolidPose *pose, const float x[3], float v[3]);

/* Acceleration of the solid's matter at x, m/s2, by the rates of the step. */
void solid_acceleration_at(const SolidStep *step, const float x[3], float a[3]);

/* Block around a particle's way, m, in the box's frame. */
typedef struct WayBounds {
    float low[3], high[3];
} WayBounds;

/* Bounds of the straight way from `before` to x. */
static inline WayBounds way_bounds(const float before[3], const float x[3])
{
    WayBounds way;
    for (int k = 0; k < 3; k++) {
        way.low[k] = before[k] < x[k] ? before[k] : x[k];
        way.high[k] = before[k] > x[k] ? before[k] : x[k];
    }
    return way;
}

/* True where solid_guard would find nothing to do: for nearly all particles beside a still solid. */
static inline bool solid_step_beside(const SolidStep *step, int dimensions, const WayBounds *way)
{
    return step->still && (way->high[0] < step->low[0] || way->low[0] > step->high[0] ||
                           way->high[1] < step->low[1] || way->low[1] > step->high[1] ||
                           (dimensions == 3 && (way->high[2] < step->low[2] || way->low[2] > step->high[2])));
}

/* Keeps a particle on a way from `before` to x out of the solid, on the side of `before`, however thin the
   solid is there. Removes the velocity into the surface. True if x and v had to change. */
bool solid_guard(const SolidDef *solid, const SolidStep *step, int dimensions, const float before[3],
                 float x[3], float v[3]);

/* Boundary particles: how fluid sees solids. Layers of particles follow a solid's surface, the first half a
   spacing behind, down to the support radius; curved layers are at the mean distance of their matter. Each
   particle has a volume of spacing^dimensions, and all have the solid's, whatever the size in spacings: a
   solid displaces its volume. Sums over neighbours treat boundary particles like particles of a lattice at
   rest (Akinci 2012; Adami 2012). */

typedef struct Boundary {
    size_t count;
    float *rest;    /* 3 per particle: in the solid's frame, m */
    uint8_t *solid; /* per particle: index into WorldDef.solids */
} Boundary;

/* Creates the boundary particles of all solids of the def; without solids nothing is allocated. Returns false
   if memory is short. */
bool boundary_create(Boundary *boundary, const WorldDef *def);
void boundary_destroy(Boundary *boundary);

/* The layers of one solid, not a mesh, up to `depth` m behind the surface: writes 3 floats per particle, in
   the solid's frame, m, and returns the number of particles. With NULL only counts. In two dimensions all
   have z = 0. */
size_t boundary_layers(const SolidDef *solid, int dimensions, double spacing, double depth, float *position);

/* Estimates the number of particles without making them; meshes too. */
double boundary_estimate(const SolidDef *solid, int dimensions, double spacing, double depth);

/* Boundary particles of a mesh: layers at 0.5, 1.5, ... spacings behind the surface, as
   above. Points of a layer are thrown at random, then thinned by a least distance to the
   number that the layer's area needs, and then push each other apart. Where a part is too thin for a layer,
   particles lie in the part's middle. */

/* Returns 3 floats per particle, in the solid's frame, m, for the caller to free; NULL if memory is short.
   `spacing` and `depth` are in m; *count is the number of particles. Each run gives the same particles. */
float *boundary_mesh_layers(const MeshUse *mesh, double spacing, double depth, size_t *count);

/* Mass and inertia of a solid of uniform density: integrals over the volume; in two dimensions for a depth of
   1 m. */

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
   Mirtich, "Fast and accurate computation of polyhedral mass properties", 1996. Where parts overlap, the
   excess of the shape is taken off, which is right to some thousandths of the excess. */
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
   (sim/box/box.h). So the effect of the box's motion is exact, without apparent forces. Rotation uses the
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

/* Applies an impulse at x, N s: changes the body's velocities. */
void body_hit(const Body *body, const double x[3], const double blow[3], BodyState *state);

/* Speed of the body's matter at x along the unit vector n, gained by an impulse of 1 N s along n at x:
   1/kg. */
double body_yield(const Body *body, const BodyState *state, const double x[3], const double n[3]);

/* Contacts of bodies with walls, other solids and each other.

   A contact is a hull point of a body near a wall, or near another solid by signed distance. A hull point of
   a fixed solid near a body is a contact as well. A point is near if its approach in a step may reach the
   surface. Impulses along the normal keep the point from going deeper than the surface by the end of the
   step. Points faster than a fall over a spacing bounce with BODY_BOUNCE of the speed. Friction is Coulomb's,
   with BODY_FRICTION. Both constants are for wood on wood, whatever the material. Impulses are found contact
   by contact, a fixed number of times in a fixed order (Catto, "Iterative dynamics with temporal coherence",
   2005), so the bits depend on nothing else. Bodies that still overlap at the end of a step are moved apart,
   without velocity. Hinged bodies stay. */

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

/* The floating solids of a world, over the steps. */

typedef struct Bodies Bodies;

/* Surroundings of the bodies. Def and walls must outlive the bodies; the def may change only as far as a
   living world allows. */
typedef struct BodiesIn {
    const WorldDef *def;
    const Walls *walls;
    double reach; /* h, m */
    bool sounds;  /* true: sound carries pressure; false: pressure holds the density within a step */
    bool leaps;   /* fluid falls and drifts through the whole step before pressure acts */
} BodiesIn;

/* A step of the bodies. */
typedef struct BodiesStep {
    double time, dt;                 /* begin and length of the step, s */
    BoxState box[3];                 /* at begin, middle and end of the step */
    const ApparentGravity *apparent; /* in the middle */
    const float *gravity;            /* in the box's axes in the middle, m/s2 */
    SolidStep (*solids)[SOLIDS_MAX]; /* of both halves; entries of floating solids are outputs */
} BodiesStep;

/* Creates the bodies at time 0; free with bodies_destroy. *bodies is NULL if no solid floats. Returns false
   if memory is short. */
bool bodies_create(Bodies **bodies, const BodiesIn *in, Error *error);
void bodies_destroy(Bodies *bodies); /* NULL is allowed */

/* Finds the deepest overlap of solid number `solid` at the start, if deeper than half a spacing. Returns
   false without such an overlap, or if the solid does not float. */
bool bodies_overlap(const Bodies *bodies, int solid, BodyOverlap *overlap);

/* Sums of the forces on the bodies, filled in by a backend (Backend.enable_forces). */
Forces *bodies_forces(Bodies *bodies);

/* From now on, forces on bodies and box are also added to `to`; NULL: no longer. */
void bodies_copy_forces(Bodies *bodies, Forces *to);

/* Writes the poses of the floating solids; entries of further solids stay unchanged. Either array may be
   NULL. */
void bodies_poses(const Bodies *bodies, BoxState floating[SOLIDS_MAX], SolidPose pose[SOLIDS_MAX]);

/* Moves the bodies through the first half of a step, with BodiesIn.leaps through both. Arrays in `step` must
   stay valid until the step's end. */
void bodies_begin(Bodies *bodies, const BodiesStep *step);

/* Applies the fluid forces up to the kick, and contacts; then moves the bodies through the second half. With
   BodiesIn.leaps only velocities change, and the call may come at the step's end. */
void bodies_kick(Bodies *bodies);

/* Ends a step: keeps the forces since the kick for the next kick. With forces under way from a device,
   bodies_end_later comes at the step's end, and bodies_end before the next kick or save. bodies_owe_end: true
   in between. */
void bodies_end(Bodies *bodies);
void bodies_end_later(Bodies *bodies);
bool bodies_owe_end(const Bodies *bodies);

/* Greatest distance by which overlaps were moved apart in the last step, m. No force does the work of these
   shifts. */
double bodies_shift(const Bodies *bodies);

/* Upper bound of the speed of the bodies' matter, m/s; NaN if a state is not finite. */
double bodies_speed(const Bodies *bodies);

/* Adds the energy, mass, positions and momenta of the bodies. */
void bodies_sums(const Bodies *bodies, EnergySums *sums);

void bodies_save(const Bodies *bodies, BodyStates *to);
void bodies_load(Bodies *bodies, const BodyStates *from);

/* True if the orientations of all floating solids in `states` are unit quaternions. */
bool bodies_are_valid(const Bodies *bodies, const BodyStates *states);

#endif
