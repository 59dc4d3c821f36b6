/* All solids of a world that float, over its steps. */
#ifndef SLOSH_BODIES_H
#define SLOSH_BODIES_H

#include "sim/base/error.h"
#include "sim/body/body_contact.h"
#include "sim/body/body_state.h"
#include "sim/box/box_step.h"
#include "sim/box/wall.h"
#include "sim/matter/energy_sums.h"
#include "sim/matter/solid_step.h"

typedef struct Bodies Bodies;

/* What they are among. Def and walls outlive them; of the def may change what may while a world lives. */
typedef struct BodiesIn {
    const WorldDef *def;
    const Walls *walls;
    double reach; /* h, m */
    bool sounds;  /* sound carries pressure: else it holds the density within a step */
    bool leaps;   /* fluid falls and flies the whole step before it is pushed */
} BodiesIn;

/* A step of theirs. */
typedef struct BodiesStep {
    double time, dt;                 /* of its begin; s */
    BoxState box[3];                 /* at its begin, middle and end */
    const ApparentGravity *apparent; /* in the middle */
    const float *gravity;            /* in the box's axes in the middle, m/s2 */
    SolidStep (*solids)[SOLIDS_MAX]; /* of both halves: those of what floats are filled in */
} BodiesStep;

/* At the start. True with *bodies NULL where no solid floats; false when memory is short. */
bool bodies_create(Bodies **bodies, const BodiesIn *in, Error *error);
void bodies_destroy(Bodies *bodies); /* NULL is allowed */

/* What the body that is solid number `solid` overlaps with most at the start, by more than half a spacing;
   false: nothing, or it doesn't float. */
bool bodies_overlap(const Bodies *bodies, int solid, BodyOverlap *overlap);

/* Where a backend sums what they feel (Backend.feel). */
Forces *bodies_felt(Bodies *bodies);

/* What they and the box feel is added to `to` as well. */
void bodies_tell(Bodies *bodies, Forces *to);

/* Where they are; of other solids nothing is written. NULL: not wanted. */
void bodies_poses(const Bodies *bodies, BoxState floating[SOLIDS_MAX], SolidPose pose[SOLIDS_MAX]);

/* Through the first half of a step, whose members stay until bodies_end. */
void bodies_begin(Bodies *bodies, const BodiesStep *step);

/* By what the fluid did to them until the kick, and what they touch; then through the second half. */
void bodies_kick(Bodies *bodies);

/* Behind a step. */
void bodies_end(Bodies *bodies);

/* How far overlaps were moved apart in the last step, m: what is lifted and pressed so is nobody's work. */
double bodies_parted(const Bodies *bodies);

/* The greatest speed of their matter, m/s; NaN where a number is none. */
double bodies_speed(const Bodies *bodies);

/* Adds what they have of energy, mass, places and momenta. */
void bodies_sums(const Bodies *bodies, EnergySums *sums);

void bodies_save(const Bodies *bodies, BodyStates *to);
void bodies_load(Bodies *bodies, const BodyStates *from);

/* Whether it is the state of all that float. */
bool bodies_sane(const Bodies *bodies, const BodyStates *states);

#endif
