/* Data of a method's substep. */
#ifndef SIM_STEP_SUBSTEP_H
#define SIM_STEP_SUBSTEP_H

#include "sim/solids/bodies.h"
#include "sim/solids/solid.h"
#include "sim/step/backend.h"
#include "slosh/world.h"

/* Data of a substep, with the poses of the box at begin, middle and end. */
typedef struct Substep {
    const Backend *backend;
    void *state;
    const Constants *constants;
    StageClock *clock; /* may be NULL */
    double dt;         /* s */
    double speed;      /* greatest in the last step, m/s; on a GPU in the last frame */
    StepSolve *solves; /* by number, SOLVES_MAX entries: results of the step's solvers */
    BoxStep first_half, second_half;
    double *driven;  /* J: sum of the emitters' work */
    int guide_count; /* of active emitters */
    Guide guides[GUIDES_MAX];
    FingerStep finger;               /* the finger in the fluid */
    SolidStep solids[2][SOLIDS_MAX]; /* for both halves; first_half and second_half point here */
    Bodies *bodies;                  /* floating solids; NULL: none */
    ApparentGravity apparent;        /* at the middle */
    float gravity[3];                /* in the box's axes at the middle, m/s2 */
} Substep;

/* Input of passes over `dt` (s). */
static inline PassInput substep_input(const Substep *step, double dt)
{
    PassInput input = {.dt = (float)dt, .apparent = &step->apparent};
    for (int k = 0; k < 3; k++)
        input.gravity[k] = step->gravity[k];
    return input;
}

/* Runs a pass of the method over `dt` (s). */
static inline void substep_run(const Substep *step, const Pass *pass, double dt)
{
    const PassInput input = substep_input(step, dt);
    step->backend->run(step->state, pass, &input);
}

/* Runs the scene's shared terms before the kick, from the present velocities and accelerations. */
static inline void substep_terms(const Substep *step)
{
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->substep && (*term)->needed(step->constants))
            STAGE (step->clock, STAGE_SOLVE)
                (*term)->substep(step);
}

/* A step of the method, with the terms' begin and end. */
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

/* The kick of a step, then the effects of finger, emitters and floating bodies. */
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
