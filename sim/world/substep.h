/* What the substep of a method works on. */
#ifndef SLOSH_SUBSTEP_H
#define SLOSH_SUBSTEP_H

#include "sim/body/bodies.h"
#include "sim/matter/solid_step.h"
#include "sim/touch/finger.h"
#include "sim/world/backend.h"

/* What a substep works on: the poses of the box at its begin, middle and end among it. */
typedef struct Substep {
    const Backend *backend;
    void *state;
    const Constants *constants;
    StageClock *clock; /* may be NULL */
    double dt;         /* s */
    double speed;      /* greatest of the step before, m/s; on a GPU of the frame before */
    StepSolve *solves; /* by number, SOLVES_MAX of them: what the solvers of the step did */
    BoxStep first_half, second_half;
    double *driven;  /* J: where the work of emitters adds up */
    int guide_count; /* of those at work */
    Guide guides[GUIDES_MAX];
    FingerStep finger;               /* of who touches the fluid */
    SolidStep solids[2][SOLIDS_MAX]; /* in the two halves: what these point to */
    Bodies *bodies;                  /* solids that float; NULL: none */
    ApparentGravity apparent;        /* in the middle */
    float gravity[3];                /* in the box's axes in the middle, m/s2 */
} Substep;

/* What passes over `dt` (s) may want to know. */
static inline PassInput substep_input(const Substep *step, double dt)
{
    PassInput input = {.dt = (float)dt, .apparent = &step->apparent};
    for (int k = 0; k < 3; k++)
        input.gravity[k] = step->gravity[k];
    return input;
}

/* A pass of the method over `dt` (s). */
static inline void substep_run(const Substep *step, const Pass *pass, double dt)
{
    const PassInput input = substep_input(step, dt);
    step->backend->run(step->state, pass, &input);
}

/* What the scene names of terms that methods share, before the kick: by the velocities and accelerations that
   are there. */
static inline void substep_terms(const Substep *step)
{
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->substep && (*term)->needed(step->constants))
            STAGE (step->clock, STAGE_SOLVE)
                (*term)->substep(step);
}

/* A step of the method, with what stands before and behind it. */
static inline void substep_whole(const Substep *step, void (*method)(const Substep *step))
{
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->begin && (*term)->needed(step->constants))
            (*term)->begin(step);
    method(step);
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->end && (*term)->needed(step->constants))
            (*term)->end(step);
}

/* The kick of a step, and what a finger and emitters make of it. */
static inline void substep_kick(const Substep *step)
{
    step->backend->kick(step->state, step->gravity, (float)step->dt);
    if (step->finger.on)
        step->backend->touch(step->state, &step->finger);
    if (step->guide_count > 0)
        *step->driven += step->backend->guide(step->state, step->guides, step->guide_count);
    if (step->bodies && step->backend->felt)
        step->backend->felt(step->state);
    if (step->bodies)
        bodies_kick(step->bodies);
}

#endif
