/* The floating solids of a world, over the steps. */
#ifndef SIM_SOLIDS_BODIES_H
#define SIM_SOLIDS_BODIES_H

#include "sim/box/box_step.h"
#include "sim/box/walls.h"
#include "sim/solids/body.h"
#include "sim/solids/solid.h"
#include "slosh/error.h"
#include "slosh/state.h"

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

/* Sums of the forces on the bodies, filled in by a backend (Backend.feel). */
Forces *bodies_felt(Bodies *bodies);

/* From now on, forces on bodies and box are also added to `to`; NULL: no longer. */
void bodies_tell(Bodies *bodies, Forces *to);

/* Writes the poses of the floating solids; entries of further solids stay unchanged. Either array may be
   NULL. */
void bodies_poses(const Bodies *bodies, BoxState floating[SOLIDS_MAX], SolidPose pose[SOLIDS_MAX]);

/* Moves the bodies through the first half of a step, with BodiesIn.leaps through both. Arrays in `step` must
   stay valid until bodies_end. */
void bodies_begin(Bodies *bodies, const BodiesStep *step);

/* Applies the fluid forces up to the kick, and contacts; then moves the bodies through the second half,
   unless BodiesIn.leaps. */
void bodies_kick(Bodies *bodies);

/* Ends a step: keeps the forces since the kick for the next kick. */
void bodies_end(Bodies *bodies);

/* Greatest distance by which overlaps were moved apart in the last step, m. No force does the work of these
   shifts. */
double bodies_parted(const Bodies *bodies);

/* Upper bound of the speed of the bodies' matter, m/s; NaN if a state is not finite. */
double bodies_speed(const Bodies *bodies);

/* Adds the energy, mass, positions and momenta of the bodies. */
void bodies_sums(const Bodies *bodies, EnergySums *sums);

void bodies_save(const Bodies *bodies, BodyStates *to);
void bodies_load(Bodies *bodies, const BodyStates *from);

/* True if the orientations of all floating solids in `states` are unit quaternions. */
bool bodies_are_valid(const Bodies *bodies, const BodyStates *states);

#endif
