#include "sim/base/base.h"
#include "sim/flow/flow.h"
#include "sim/step/substep.h"
#include "sim/step/world.h"
#include "sim/world.h"

#include <math.h>

/* Shares of the sentinel's bounds: a particle may cross a support radius per step, and fluid stays well
   below the speed of sound. */
static FingerLimits finger_limits(const World *world)
{
    static const double OF_BOUND = 0.25, OF_SOUND = 0.3, OF_GAIN = 0.1;
    const double bound = (double)world->constants.support_radius / world->stepping.dt;
    const double sound = world->method->incompressible ? INFINITY : world->def.sound_speed;
    return (FingerLimits){fmin(OF_BOUND * bound, OF_SOUND * sound), OF_GAIN * fmin(bound, sound)};
}

/* Moves box, filter and finger to the end of the substep. */
static void substep_prepare(World *world, StageClock *clock, Substep *step)
{
    const double at = (double)world->step, dt = world->stepping.dt;
    const BoxState begin = world->box;
    BoxState middle;
    box_filter_step(&world->filter, &world->target, &world->def.limits, 0.5 * dt);
    world_box_at(world, &world->filter, world_time_at(world, at + 0.5), &middle);
    box_filter_step(&world->filter, &world->target, &world->def.limits, 0.5 * dt);
    world_box_at(world, &world->filter, world_time_at(world, at + 1), &world->box);

    step->backend = world->backend;
    step->state = world->state;
    step->clock = clock;
    step->dt = dt;
    step->speed = world->stepping.max_speed;
    step->constants = &world->constants;
    step->solves = world->solves;
    step->driven = &world->energy.work;
    energy_note_jump(world, &begin);
    box_step(&begin, &middle, 0.5 * dt, &step->first_half);
    box_step(&middle, &world->box, 0.5 * dt, &step->second_half);
    const FingerLimits limits = finger_limits(world);
    finger_step(&world->finger, &limits, dt, &step->finger);
    step->guide_count = flow_guides(&world->def, world_time_at(world, at), world->closed, step->guides);
    Emit poured;
    int fluid;
    if (world_pours(world, &poured, &fluid))
        step->guides[step->guide_count++] = flow_guide(&world->def, fluid, &poured);
    for (int i = 0; i < world->def.solid_count; i++)
        for (int half = 0; half < 2; half++)
            solid_step_make(&world->def.solids[i], world_time_at(world, at + 0.5 * half),
                            world_time_at(world, at + 0.5 * half + 0.5), &step->solids[half][i]);
    for (int i = 0; i < world->def.solid_count; i++)
        solid_step_mean(&step->solids[0][i], &step->solids[1][i]);
    step->first_half.solids = world->def.solid_count > 0 ? step->solids[0] : NULL;
    step->second_half.solids = world->def.solid_count > 0 ? step->solids[1] : NULL;
    apparent_gravity(world->def.gravity, &begin, &middle, &world->box, dt, &step->apparent);
    double gravity[3];
    quat_rotate_inverse(middle.orientation, world->def.gravity, gravity);
    for (int k = 0; k < 3; k++)
        step->gravity[k] = (float)gravity[k];
    step->bodies = world->bodies;
    if (world->bodies)
        bodies_begin(world->bodies, &(BodiesStep){.time = world_time_at(world, at),
                                                  .dt = dt,
                                                  .box = {begin, middle, world->box},
                                                  .apparent = &step->apparent,
                                                  .gravity = step->gravity,
                                                  .solids = step->solids});
}

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* step_pressure in the moving box: apparent gravity is that of the prescribed motion over a step as long as
   the last one. A jolt counts as at most JOLT times gravity, since the jolt is over after a step. */
static double pressure_limit(const World *world)
{
    static const double JOLT = 16;
    const double at = (double)world->step, dt = world->stepping.dt, weight = length(world->def.gravity);
    const double stands = step_pressure(&world->def);
    if (!isfinite(stands) || !(dt > 0))
        return stands;
    BoxState begin, middle, end;
    ApparentGravity apparent;
    world_box_at(world, &world->filter, world_time_at(world, at), &begin);
    world_box_at(world, &world->filter, world_time_at(world, at + 0.5), &middle);
    world_box_at(world, &world->filter, world_time_at(world, at + 1), &end);
    apparent_gravity(world->def.gravity, &begin, &middle, &end, dt, &apparent);
    const double pull[3] = {(double)apparent.origin[0], (double)apparent.origin[1],
                            (double)apparent.origin[2]};
    return stands / sqrt(fmin(fmax(length(pull) / weight, 1), JOLT));
}

/* The size of the next step. On a change, time counts from here. */
static void choose_step(World *world)
{
    const WorldDef *def = &world->def;
    StepState *s = &world->stepping;
    StepLimit limit = STEP_LIMIT_DT;
    const double before = world->step > 0 ? s->wanted : 0;
    s->wanted = def->step_mode == STEP_CFL
                    ? step_cfl(def, &world->constants.friction, s->max_speed,
                               s->max_acceleration + finger_acceleration(&world->finger), before, &limit)
                    : def->dt / def->substeps;
    const double stands = def->step_mode == STEP_CFL ? pressure_limit(world) : INFINITY;
    if (stands < s->wanted) {
        s->wanted = stands;
        limit = STEP_LIMIT_PRESSURE;
    }
    s->limit = limit;
    double dt = s->wanted / s->refine;
    if (def->step_mode == STEP_CFL)
        dt = step_towards(dt, world->stop - world_time_at(world, (double)world->step));
    if (dt == s->dt)
        return;
    world->since_time = world_time_at(world, (double)world->step);
    world->since_step = world->step;
    s->dt = dt;
}

/* Returns false if memory is short. *marked: the state is that of the mark. */
static bool begin_step(World *world, bool *marked, Error *error)
{
    StepState *s = &world->stepping;
    *marked = s->frame_left < 1 && world->def.retries > 0;
    if (s->frame_left < 1) {
        sentinel_lengthen_step(world);
        if (world->births.count > world->births_most)
            world_thin_births(world);
        if (!sentinel_mark(world, error))
            return false;
        s->frame_left = world->def.step_mode == STEP_CFL ? 1 : world->def.substeps * s->refine;
    }
    world_update_viscosities(world, world_time_at(world, (double)world->step)); /* bounds the step */
    choose_step(world);
    world_update_viscosities(world, world_time_at(world, (double)world->step + 0.5));
    return true;
}

static void count_step(World *world)
{
    world->step++;
    world->limited[(int)world->stepping.limit]++;
}

/* Spacings per step by which overlapping bodies are moved apart. Bodies at rest on something stay below; a
   larger move lifts bodies or presses bodies into fluid. */
static const double PARTED = 0.05;

static void end_of_bodies(World *world)
{
    if (world->method->leaps)
        bodies_kick(world->bodies);
    if (!bodies_owe_end(world->bodies))
        bodies_end(world->bodies);
    if (bodies_shift(world->bodies) > PARTED * world->def.spacing)
        energy_restart(world);
}

/* After a step: passes the forces on solids and box to the energy watch and to world_forces. */
static void tell_forces(World *world, const Substep *step)
{
    if (!world->sums_forces || world->backend->forces_send)
        return;
    if (energy_needs_solids(world))
        energy_of_solids(world, &world->step_forces, step->solids[0]);
    if (world->forces_wanted)
        forces_add(&world->forces, &world->step_forces);
    world->step_forces = (Forces){0};
}

/* *good: false after a wrong guess. Returns false with the reason. */
static bool take_step(World *world, StageClock *clock, bool guesses, Substep *step, bool *good, Error *error)
{
    bool flowed = world->sums_forces || !energy_needs_solids(world) || world_sum_forces(world, error);
    if (flowed && (world->constants.emits || world->def.drain_count > 0))
        STAGE (clock, STAGE_INTEGRATE)
            flowed = world_flow(world, error);
    if (!flowed)
        return false;
    substep_prepare(world, clock, step);
    if (guesses && world->backend->guess)
        world->backend->guess(world->state);
    if (world->backend->enter)
        world->backend->enter(world->state);
    substep_whole(step, world->method->substep);
    if (world->backend->energy_ahead && energy_expects_look(world))
        world->backend->energy_ahead(world->state);
    if (world->backend->leave)
        world->backend->leave(world->state);
    if (world->bodies && !world->method->leaps && world->backend->forces_send) {
        world->backend->forces_send(world->state);
        bodies_end_later(world->bodies);
    }
    *good = world_finish(world);
    return true;
}

/* Guesses of a step; then the step waits for its solvers. */
enum { GUESSES = 4 };

bool world_substep(World *world, StageClock *clock, Error *error)
{
    Substep step;
    StepState *s = &world->stepping;
    bool marked, good;
    if (s->frame_left < 1 && !world_is_valid(world)) {
        const double time = world_time_at(world, (double)world->step);
        count_step(world); /* no two states share a step number */
        return sentinel_back(world, time, error);
    }
    if (!begin_step(world, &marked, error) || !take_step(world, clock, marked, &step, &good, error))
        return false;
    for (int wrong = 1; !good; wrong++) {
        sentinel_again(world);
        if (!take_step(world, clock, wrong < GUESSES, &step, &good, error))
            return false;
    }
    if (world->bodies)
        end_of_bodies(world);
    tell_forces(world, &step);
    world->kicked = true;
    count_step(world);
    if (world->backend->gpu) {
        sentinel_note_solves(world);
        if (s->frame_left > 1) /* the end of a frame is looked at when it was waited for */
            energy_is_valid(world);
    } else if (!world_is_valid(world) || !energy_is_valid(world))
        return sentinel_back(world, world_time_at(world, (double)world->step), error);
    if (world->method->solvers[0].name || world->constants.implicit.on)
        solve_tally_add(&world->tally, world->solves);
    s->frame_left--;
    s->steps_since_trouble++;
    return true;
}

bool world_step(World *world, StageClock *clock, Error *error)
{
    bool good = true;
    do
        good = world_substep(world, clock, error);
    while (good && world->stepping.frame_left != 0);
    return good;
}
