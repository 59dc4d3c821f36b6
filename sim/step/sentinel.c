#include "sim/solids/solid.h"
#include "sim/step/substep.h"
#include "sim/step/world.h"

#include <stdio.h>
#include <string.h>

static const double CALM_STEPS = 200;

bool sentinel_mark(World *world, Error *error)
{
    const Backend *backend = world->backend;
    if (world->def.retries == 0)
        return true;
    world->forces_before = world->forces;
    if (!backend->mark)
        return world_save(world, &world->good, error);
    world_save_numbers(world, &world->good.numbers);
    world->good.count = world->count;
    return backend->mark(world->state, error);
}

/* True if steps of twice the length would boil by friction, with the same trouble again. */
static bool friction_forbids(const World *world)
{
    const StepState *s = &world->stepping;
    return 2 * s->wanted / s->refine >
           STEP_VISCOUS_STANDS * step_viscous(&world->def, &world->constants.friction);
}

void sentinel_lengthen_step(World *world)
{
    StepState *s = &world->stepping;
    if (s->refine <= 1 || s->steps_since_trouble < CALM_STEPS * s->refine || friction_forbids(world))
        return;
    s->refine /= 2;
    s->tries--;
    s->steps_since_trouble = 0;
}

static void put_back(World *world)
{
    const WorldNumbers *numbers = &world->good.numbers;
    world->forces = world->forces_before;
    world->step_forces = (Forces){0};
    world->filter = numbers->filter;
    world->box = numbers->box;
    if (world->bodies)
        bodies_load(world->bodies, &numbers->bodies);
    if (world->backend->back)
        world->backend->back(world->state, world->good.count, (size_t)numbers->guarded);
    else
        world->backend->load(world->state, &world->good.particles, world->good.count,
                             (size_t)numbers->guarded);
    world_put_back(world, numbers, world->good.count);
}

static void restore(World *world)
{
    const WorldNumbers *numbers = &world->good.numbers;
    world->since_step = world->step;
    world->since_time = numbers->since_time + (numbers->step - numbers->since_step) * numbers->stepping.dt;
    if (finger_on(&numbers->finger) && finger_on(&world->finger)) /* the requested finger stays */
        memcpy(world->finger.point, numbers->finger.point, sizeof world->finger.point);
    if (world->energy.until > 0) /* 0: forgotten since then, by a change that stays after going back */
        world->energy = numbers->energy;
    world->stepping.max_speed = numbers->stepping.max_speed;
    world->stepping.max_acceleration = numbers->stepping.max_acceleration;
    world->stepping.frame_left = -1;
    world->stepping.steps_since_trouble = 0;
    put_back(world);
}

void sentinel_again(World *world)
{
    world->finger = world->good.numbers.finger;
    world->energy = world->good.numbers.energy;
    put_back(world);
}

/* Advice on the solver in trouble or on the step. */
static void advise(const World *world, StepTrouble trouble, double dt, char words[200])
{
    const WorldDef *def = &world->def;
    const MethodSolver *solver = world->trouble.solver;
    if (trouble == STEP_TROUBLE_SOLVE)
        snprintf(words, 200, "use %s, more %s or a larger %s",
                 def->step_mode == STEP_CFL ? "a smaller solver.step.number"
                                            : "a smaller solver.step.dt, more solver.step.substeps",
                 solver->iterations, solver->tolerance);
    else
        step_advice(def, &world->constants.friction, trouble, dt, world->stepping.max_speed, words);
}

static bool give_up(World *world, StepTrouble trouble, double time, Error *error)
{
    const int retries = world->def.retries;
    const StepState *s = &world->stepping;
    const double dt =
        world->def.step_mode == STEP_CFL ? s->dt * s->refine : world->def.dt / world->def.substeps;
    char also[96] = "", advice[200], words[160];
    world_trouble_words(&world->trouble, words);
    advise(world, trouble, dt, advice);
    if (retries > 0)
        snprintf(also, sizeof also, ", with 1/%d of the step too; the state at t = %g s is kept",
                 1 << retries, world_time_at(world, (double)world->step));
    return error_set(error, "the simulation %s at t = %g s: %s%s; %s",
                     trouble == STEP_TROUBLE_SOLVE ? "stopped" : "blew up", time, words, also, advice);
}

/* A smaller step does not help: no retry. */
static bool give_up_lost(World *world, Error *error)
{
    WorldInfo info = {0};
    char lost[32], settings[128];
    world->backend->info(world->state, &info);
    if (world->def.retries > 0)
        restore(world);
    number_grouped(info.lost, lost);
    world->backend->to_raise(world->state, settings);
    return error_set(error, "%s %s; raise %s", lost, step_trouble_words(STEP_TROUBLE_LOST), settings);
}

static bool give_up_memory(World *world, Error *error)
{
    if (world->def.retries > 0)
        restore(world);
    return error_set(error, "%s; use a larger spacing or a smaller particles.support",
                     step_trouble_words(STEP_TROUBLE_MEMORY));
}

bool sentinel_back(World *world, double time, Error *error)
{
    const StepTrouble trouble = world->seen;
    StepState *s = &world->stepping;
    WorldTrouble *trouble_out = &world->trouble;
    const bool helps = trouble != STEP_TROUBLE_LOST && trouble != STEP_TROUBLE_MEMORY;
    trouble_out->what = trouble;
    trouble_out->time = time;
    trouble_out->ended = !helps || s->tries >= world->def.retries;
    if (trouble == STEP_TROUBLE_LOST)
        return give_up_lost(world, error);
    if (trouble == STEP_TROUBLE_MEMORY)
        return give_up_memory(world, error);
    if (world->def.retries == 0)
        return give_up(world, trouble, time, error);
    restore(world);
    if (trouble_out->ended)
        return give_up(world, trouble, time, error);
    s->refine *= 2;
    s->tries++;
    trouble_out->count++;
    trouble_out->back_to = world->since_time;
    trouble_out->tries = (int)s->tries;
    return true;
}
