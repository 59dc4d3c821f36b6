#include "sim/step/sentinel.h"

#include "sim/solids/bodies.h"
#include "sim/step/iterate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double CALM_STEPS = 200;

bool sentinel_mark(World *world, Error *error)
{
    const Backend *backend = world->backend;
    if (world->def.retries == 0)
        return true;
    world->felt_before = world->felt;
    if (!backend->mark)
        return world_save(world, &world->good, error);
    world_save_numbers(world, &world->good.numbers);
    world->good.count = world->count;
    return backend->mark(world->state, error);
}

/* Finds the first solver in trouble. */
static void look_at_solves(World *world)
{
    for (int k = 0; k < SOLVES_MAX && !world->seen && world->def.retries > 0; k++)
        if (world->solves[k].failed) {
            world->seen = STEP_TROUBLE_SOLVE;
            world->trouble.solver = solver_of(world->method, k);
            world->trouble.left = world->solves[k];
        }
}

void sentinel_note_solves(World *world)
{
    bool numbers = true;
    for (int k = 0; k < SOLVES_MAX; k++)
        numbers &= isfinite(world->solves[k].mean);
    if (numbers)
        look_at_solves(world);
}

/* Floating bodies bound the next step like particles. */
static void look_at_bodies(World *world)
{
    StepState *s = &world->stepping;
    const double speed = world->bodies ? bodies_speed(world->bodies) : 0;
    if (!world->seen && !(speed * s->dt <= (double)world->constants.support_radius))
        world->seen = STEP_TROUBLE_SOLID;
    else
        s->max_speed = fmax(s->max_speed, speed);
}

bool world_is_valid(World *world)
{
    StepState *s = &world->stepping;
    if (world->kicked) {
        const StepWatch watch = world->backend->watch(world->state);
        const StepTrouble trouble = step_trouble_of(&watch, world->def.retries > 0);
        s->max_speed = watch.max_speed;
        s->max_acceleration = watch.max_acceleration;
        world->seen = world->seen ? world->seen : trouble;
        look_at_bodies(world);
        look_at_solves(world);
        world->kicked = false;
        if (world->backend->gpu && !world->seen)
            energy_is_valid(world);
        if (!world->seen)
            world->fastest = fmax(world->fastest, (double)watch.max_speed);
    }
    return world->seen == STEP_TROUBLE_NONE;
}

/* True if steps of twice the length would boil by friction, with the same trouble again. */
static bool friction_forbids(const World *world)
{
    const StepState *s = &world->stepping;
    return 2 * s->wanted / s->refine >
           STEP_VISCOUS_STANDS * step_viscous(&world->def, &world->constants.friction);
}

void sentinel_relieve(World *world)
{
    StepState *s = &world->stepping;
    if (s->refine <= 1 || s->calm < CALM_STEPS * s->refine || friction_forbids(world))
        return;
    s->refine /= 2;
    s->tries--;
    s->calm = 0;
}

static void restore(World *world)
{
    const WorldNumbers *numbers = &world->good.numbers;
    world->felt = world->felt_before;
    world->pushed = (Forces){0};
    world->since_step = world->step;
    world->since_time = numbers->since_time + (numbers->step - numbers->since_step) * numbers->stepping.dt;
    world->filter = numbers->filter;
    world->box = numbers->box;
    if (finger_on(&numbers->finger) && finger_on(&world->finger)) /* the requested finger stays */
        memcpy(world->finger.point, numbers->finger.point, sizeof world->finger.point);
    if (world->energy.until > 0) /* 0: forgotten since then, by a change that stays after going back */
        world->energy = numbers->energy;
    if (world->bodies)
        bodies_load(world->bodies, &numbers->bodies);
    world->stepping.max_speed = numbers->stepping.max_speed;
    world->stepping.max_acceleration = numbers->stepping.max_acceleration;
    world->stepping.frame_left = -1;
    world->stepping.calm = 0;
    if (world->backend->back)
        world->backend->back(world->state, world->good.count, (size_t)numbers->guarded);
    else
        world->backend->load(world->state, &world->good.particles, world->good.count,
                             (size_t)numbers->guarded);
    world_put_back(world, numbers, world->good.count);
}

void world_trouble_words(const WorldTrouble *trouble, char words[160])
{
    const StepSolve *left = &trouble->left;
    if (trouble->what == STEP_TROUBLE_SOLVE)
        snprintf(words, 160,
                 "the solver of %s does not converge: %s %g leaves %.3g %% in the mean, %s is %.3g %%",
                 trouble->solver->name, trouble->solver->iterations, left->iterations, 100 * left->mean,
                 trouble->solver->tolerance, 100 * left->tolerance);
    else
        snprintf(words, 160, "%s", step_trouble_words(trouble->what));
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
    WorldTrouble *told = &world->trouble;
    const bool helps = trouble != STEP_TROUBLE_LOST && trouble != STEP_TROUBLE_MEMORY;
    told->what = trouble;
    told->time = time;
    told->ended = !helps || s->tries >= world->def.retries;
    if (trouble == STEP_TROUBLE_LOST)
        return give_up_lost(world, error);
    if (trouble == STEP_TROUBLE_MEMORY)
        return give_up_memory(world, error);
    if (world->def.retries == 0)
        return give_up(world, trouble, time, error);
    restore(world);
    if (told->ended)
        return give_up(world, trouble, time, error);
    s->refine *= 2;
    s->tries++;
    told->count++;
    told->back_to = world->since_time;
    told->tries = (int)s->tries;
    return true;
}
