#include "sim/base/parallel.h"
#include "sim/def/fluids.h"
#include "sim/flow/flow.h"
#include "sim/step/sentinel.h"
#include "sim/step/substep.h"
#include "sim/step/world.h"
#include "slosh/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const Named *world_backends(void)
{
    static Named list[BACKENDS_MAX + 1];
    const Backend *const *backends = backend_list();
    for (int i = 0; backends[i]; i++)
        list[i] = (Named){backends[i]->name, backends[i]->help};
    return list;
}

const Named *world_methods(void)
{
    static Named list[METHODS_MAX + 1];
    const Method *const *methods = method_list();
    for (int i = 0; methods[i]; i++)
        list[i] = (Named){methods[i]->name, methods[i]->help};
    return list;
}

int world_processors(void)
{
    return parallel_processors();
}

/* The pose at `time`, with the hand's part from `filter`. */
static void box_at(const World *world, const BoxFilter *filter, double time, BoxState *box)
{
    box_state_at(world->def.motions, world->def.motion_count, world->def.box_size[1], time, box);
    box_filter_apply(filter, world->def.box_size[1], box);
}

void world_pose(World *world)
{
    box_at(world, &world->filter, world_time_at(world, (double)world->step), &world->box);
}

void world_recompute_derived(World *world)
{
    SolidPose pose[SOLIDS_MAX];
    for (int i = 0; i < world->def.solid_count; i++)
        solid_pose_at(&world->def.solids[i], world_time_at(world, (double)world->step), &pose[i]);
    if (world->bodies)
        bodies_poses(world->bodies, NULL, pose);
    if (world->def.solid_count > 0)
        world->backend->pose(world->state, pose);
    world->backend->grid(world->state);
    world->backend->run(world->state, world->method->settle, &(PassInput){0});
}

static void start_method(World *world)
{
    const Pass *const *pass = world->method->start;
    for (; pass && *pass; pass++)
        if (!(*pass)->needed || (*pass)->needed(&world->constants))
            world->backend->run(world->state, *pass, &(PassInput){0});
}

void world_clear_unknown(World *world, const ParticleColumns *known)
{
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->unknown && (*term)->needed(&world->constants) &&
            !(known && known->own[column_own((*term)->columns)]))
            world->backend->run(world->state, (*term)->unknown, &(PassInput){0});
}

static bool names_check(const WorldDef *def, Error *error)
{
    if (!backend_find(def->backend))
        return error_set(error, "unknown backend '%s'; `slosh info` lists them", def->backend);
    return method_find(def->method) ||
           error_set(error, "unknown method '%s'; `slosh info` lists them", def->method);
}

bool world_can(const WorldDef *def, Error *error)
{
    if (!names_check(def, error))
        return false;
    const Backend *backend = backend_find(def->backend);
    return !backend->can || backend->can(def, error);
}

void world_update_viscosities(World *world, double time)
{
    if (!world->constants.varies)
        return;
    world_def_at(&world->def, time);
    if (constants_vary(&world->constants, &world->def) && world->backend->vary)
        world->backend->vary(world->state);
}

void world_stop_at(World *world, double time)
{
    world->stop = time;
}

/* A world with particles in place, before any density or pressure. */
static World *world_unsettled(const WorldDef *def, Error *error)
{
    World *world = calloc(1, sizeof *world);
    if (!world) {
        error_set(error, "no memory");
        return NULL;
    }
    world->def = *def;
    if (def->dimensions == 2)
        world->def.box_size[2] = def->spacing;
    world->backend = backend_find(def->backend);
    world->method = method_find(def->method);
    if (!names_check(def, error) || !constants_create(&world->constants, def, error) ||
        !world_can(def, error) || !world_start(world, error)) {
        world_destroy(world);
        return NULL;
    }
    return world;
}

bool world_fits(const WorldDef *def, Error *error)
{
    World *world = world_unsettled(def, error);
    world_destroy(world);
    return world != NULL;
}

World *world_create(const WorldDef *def, Error *error)
{
    World *world = world_unsettled(def, error);
    if (!world)
        return NULL;
    world_update_viscosities(world, 0);
    world->filter = box_filter_at_rest();
    world->target = (BoxTarget){.orientation = {0, 0, 0, 1}};
    world->stepping = (StepState){.dt = def->dt / def->substeps, .refine = 1};
    world->trouble.retries = def->retries;
    world->shut = flow_shut(def);
    box_at(world, &world->filter, 0, &world->box);
    world_recompute_derived(world);
    start_method(world);
    world_clear_unknown(world, NULL);
    energy_is_valid(world);
    if (sentinel_mark(world, error)) /* allocates before the first step */
        return world;
    world_destroy(world);
    return NULL;
}

void world_destroy(World *world)
{
    if (!world)
        return;
    if (world->backend && world->state)
        world->backend->destroy(world->state);
    constants_destroy(&world->constants);
    world_state_free(&world->good);
    births_free(&world->births);
    free(world->layer);
    bodies_destroy(world->bodies);
    free(world);
}

/* By multiplication, not by summing: for a constant dt, a step's time depends on its number alone. */
double world_time_at(const World *world, double step)
{
    return world->since_time + (step - (double)world->since_step) * world->stepping.dt;
}

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
    box_at(world, &world->filter, world_time_at(world, at + 0.5), &middle);
    box_filter_step(&world->filter, &world->target, &world->def.limits, 0.5 * dt);
    box_at(world, &world->filter, world_time_at(world, at + 1), &world->box);

    step->backend = world->backend;
    step->state = world->state;
    step->clock = clock;
    step->dt = dt;
    step->speed = world->stepping.max_speed;
    step->constants = &world->constants;
    step->solves = world->solves;
    step->driven = &world->energy.work;
    energy_brace(world, &begin);
    box_step(&begin, &middle, 0.5 * dt, &step->first_half);
    box_step(&middle, &world->box, 0.5 * dt, &step->second_half);
    const FingerLimits limits = finger_limits(world);
    finger_step(&world->finger, &limits, dt, &step->finger);
    step->guide_count = flow_guides(&world->def, world_time_at(world, at), world->shut, step->guides);
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

/* Returns false if memory is short. */
static bool begin_step(World *world, Error *error)
{
    StepState *s = &world->stepping;
    if (s->frame_left < 1) {
        sentinel_relieve(world);
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

bool world_on_gpu(const WorldDef *def)
{
    const Backend *backend = backend_find(def->backend);
    return backend && backend->gpu;
}

bool world_reload(World *world, Error *error)
{
    return !world->backend->reload || world->backend->reload(world->state, error);
}

static void count_step(World *world)
{
    world->step++;
    world->limited[(int)world->stepping.limit]++;
}

void world_solved_restart(World *world)
{
    world->tally = (SolveTally){0};
}

/* Spacings per step by which overlapping bodies are moved apart. Bodies at rest on something stay below; a
   larger move lifts bodies or presses bodies into fluid. */
static const double PARTED = 0.05;

static void end_of_bodies(World *world)
{
    if (world->backend->felt)
        world->backend->felt(world->state);
    bodies_end(world->bodies);
    if (bodies_parted(world->bodies) > PARTED * world->def.spacing)
        energy_forget(world);
}

/* After a step: passes the forces on solids and box to the energy watch and to world_forces. */
static void tell_forces(World *world, const Substep *step)
{
    if (!world->sums_forces || world->backend->felt)
        return;
    if (energy_asks_solids(world))
        energy_of_solids(world, &world->pushed, step->solids[0]);
    if (world->feels)
        forces_add(&world->felt, &world->pushed);
    world->pushed = (Forces){0};
}

bool world_substep(World *world, StageClock *clock, Error *error)
{
    Substep step;
    StepState *s = &world->stepping;
    if (s->frame_left < 1 && !world_is_valid(world)) {
        const double time = world_time_at(world, (double)world->step);
        count_step(world); /* no two states share a step number */
        return sentinel_back(world, time, error);
    }
    if (!begin_step(world, error))
        return false;
    bool flowed = world->sums_forces || !energy_asks_solids(world) || world_sum_forces(world, error);
    if (flowed && (world->constants.emits || world->def.drain_count > 0))
        STAGE (clock, STAGE_INTEGRATE)
            flowed = world_flow(world, error);
    if (!flowed)
        return false;
    substep_prepare(world, clock, &step);
    if (world->backend->enter)
        world->backend->enter(world->state);
    substep_whole(&step, world->method->substep);
    if (world->backend->leave)
        world->backend->leave(world->state);
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
    s->calm++;
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

/* Projects the target into the plane: position without z, rotation about z. */
static void target_into_plane(BoxTarget *target)
{
    double *q = target->orientation;
    const double norm = hypot(q[2], q[3]);
    target->position[2] = q[0] = q[1] = 0;
    q[2] = norm > 0 ? q[2] / norm : 0;
    q[3] = norm > 0 ? q[3] / norm : 1;
}

static bool target_take(World *world, const BoxTarget *target)
{
    const double *q = target->orientation, *x = target->position;
    const double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(norm > 0) || !isfinite(norm) || !isfinite(x[0] + x[1] + x[2]))
        return false;
    world->target = *target;
    for (int k = 0; k < 4; k++)
        world->target.orientation[k] /= norm;
    if (world->def.dimensions == 2)
        target_into_plane(&world->target);
    if (world->constants.periodic.any) /* a periodic box does not turn */
        memcpy(world->target.orientation, (double[4]){0, 0, 0, 1}, sizeof world->target.orientation);
    return true;
}

void world_set_target(World *world, const BoxTarget *target)
{
    target_take(world, target);
}

/* Upper bound for poured fluid from sound and step, m/s. */
static double pour_speed_most(const World *world)
{
    const WorldDef *def = &world->def;
    const double sound = world->method->incompressible ? INFINITY : 0.3 * def->sound_speed;
    return fmin(sound, 0.25 * def->support * def->spacing * def->substeps / def->dt);
}

void world_set_finger(World *world, const Finger *finger)
{
    static const double WIDEST = 1000; /* spacings; largest radius of poured fluid */
    const Finger before = world->finger.wanted;
    const int fluid = finger_fluid(finger);
    Finger taken = *finger;
    if (fluid >= 0 && taken.strength > pour_speed_most(world))
        taken.strength = pour_speed_most(world);
    if (fluid >= world->def.fluid_count ||
        (fluid >= 0 && (!world->constants.emits || taken.radius > WIDEST * world->def.spacing)) ||
        !finger_take(&world->finger, &taken, world->def.dimensions))
        return;
    if (before.way != finger->way || before.strength != taken.strength) /* starts a new row of layers */
        world->pours = world_time_at(world, (double)world->step);
    energy_forget(world);
}

void world_carry_box(World *world, const BoxTarget *target)
{
    if (!target_take(world, target))
        return;
    energy_forget(world);
    world->filter = box_filter_at_rest();
    memcpy(world->filter.position, world->target.position, sizeof world->filter.position);
    memcpy(world->filter.orientation, world->target.orientation, sizeof world->filter.orientation);
    box_at(world, &world->filter, world_time_at(world, (double)world->step), &world->box);
}

bool world_adopt(World *world, const WorldDef *def, Error *error)
{
    if (!world_can(def, error) || !constants_change(&world->constants, def, error))
        return false;
    if (!world->backend->adapt(world->state, error)) {
        Error none;
        constants_change(&world->constants, &world->def, &none);
        return false;
    }
    world->def = *def;
    return true;
}

bool world_change(World *world, const WorldDef *def, Error *error)
{
    WorldDef after = world->def;
    live_copy(def, &after);
    if (!world_adopt(world, &after, error))
        return false;
    energy_forget(world);
    world_update_viscosities(world, world_time_at(world, (double)world->step));
    return true;
}

bool world_keep_acceleration(World *world, Error *error)
{
    WorldDef def = world->def;
    def.acceleration = true;
    if (world->def.acceleration)
        return true;
    if (!world_adopt(world, &def, error))
        return false;
    world_clear_unknown(world, NULL);
    return !world_is_valid(world) || sentinel_mark(world, error); /* on trouble, the sentinel must go back
                                                                  first */
}

void world_info(const World *world, WorldInfo *info)
{
    *info = (WorldInfo){
        .time = world_time_at(world, (double)world->step),
        .step = world->step,
        .count = world->count,
        .capacity = world->capacity,
        .emitted = world->emitted,
        .drained = world->drained,
        .full = world->constants.emits && world->count == world->capacity,
        .barred = world_barred(world),
        .support_radius = world->def.support * world->def.spacing,
        .spacing = world->def.spacing,
        .box = world->box,
        .touched = finger_on(&world->finger),
        .within_frame = world->stepping.frame_left != 0,
        .dt = world->stepping.dt,
        .limit = (StepLimit)world->stepping.limit,
        .fastest = world->fastest,
        .trouble = world->trouble,
        .courant = world->step > 0 ? world->stepping.dt *
                                         ((world->method->incompressible ? 0 : world->def.sound_speed) +
                                          world->stepping.max_speed) /
                                         (world->def.support * world->def.spacing)
                                   : 0,
    };
    memcpy(info->solves, world->solves, sizeof info->solves);
    info->solved = solve_tally_figures(&world->tally);
    info->solved.projects = world->method->solvers[0].name != NULL;
    info->solved.rubs = world->constants.implicit.on;
    memcpy(info->limited, world->limited, sizeof info->limited);
    if (world->bodies)
        bodies_poses(world->bodies, info->floating, NULL);
    memcpy(info->box_size, world->def.box_size, sizeof info->box_size);
    memcpy(info->hand.position, world->filter.position, sizeof info->hand.position);
    memcpy(info->hand.orientation, world->filter.orientation, sizeof info->hand.orientation);
    quat_rotate_inverse(world->box.orientation, world->def.gravity, info->gravity);
    world->backend->info(world->state, info);
}

void world_sums(World *world, WorldSums *sums)
{
    world->backend->sums(world->state, sums);
}

/* With own ids: the ids of `out` may be in memory slow to read. */
static bool read_born(World *world, const ParticleArrays *out)
{
    ParticleArrays all = *out;
    const size_t count = world->backend->held ? world->backend->held(world->state) : world->count;
    ParticleId *id = malloc((count + 1) * sizeof *id);
    all.whole_id = id;
    all.scalar[SCALAR_BORN] = NULL;
    const bool read = id && world->backend->read(world->state, &all);
    for (size_t i = 0; read && i < count; i++) {
        out->scalar[SCALAR_BORN][i] = births_time(&world->births, id[i]);
        if (out->whole_id)
            out->whole_id[i] = id[i];
    }
    free(id);
    return read;
}

bool world_read(World *world, const ParticleArrays *out)
{
    return out->scalar[SCALAR_BORN] ? read_born(world, out) : world->backend->read(world->state, out);
}
