/* Making, loading, changing and freeing a world. */
#include "sim/step/world.h"
#include "sim/base/base.h"
#include "sim/flow/flow.h"
#include "sim/solids/solid.h"
#include "sim/state.h"
#include "sim/world.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void start_method(World *world)
{
    const Pass *const *pass = world->method->start;
    const BoxState *box = &world->box;
    ApparentGravity apparent;
    apparent_gravity(world->def.gravity, box, box, box, world->def.dt, &apparent);
    for (; pass && *pass; pass++)
        if (!(*pass)->needed || (*pass)->needed(&world->constants))
            world->backend->run(world->state, *pass, &(PassInput){.apparent = &apparent});
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

/* Returns the world's own copy of a list; no list (NULL) has no copy. Clears *enough if memory is short. */
static const void *own_list(const void *list, int count, size_t size, bool *enough)
{
    const void *own = list && count > 0 ? bytes_keep(list, (size_t)count * size) : NULL;
    *enough &= own || !list || count <= 0;
    return own;
}

static bool own_motions(SolidDef solids[], int count)
{
    bool enough = true;
    for (SolidDef *solid = solids; solid < solids + count; solid++)
        solid->motions = own_list(solid->motions, solid->motion_count, sizeof *solid->motions, &enough);
    return enough;
}

/* Makes the lists of the world's checked def the world's own. */
static bool own_lists(World *world, Error *error)
{
    WorldDef *def = &world->def;
    bool enough = own_motions(def->solids, def->solid_count);
    def->motions = own_list(def->motions, def->motion_count, sizeof *def->motions, &enough);
    def->drains = own_list(def->drains, def->drain_count, sizeof *def->drains, &enough);
    for (FluidDef *fluid = def->fluids; fluid < def->fluids + def->fluid_count; fluid++) {
        fluid->fills = own_list(fluid->fills, fluid->fill_count, sizeof *fluid->fills, &enough);
        fluid->emits = own_list(fluid->emits, fluid->emit_count, sizeof *fluid->emits, &enough);
    }
    memcpy(world->constants.solids, def->solids, sizeof def->solids);
    return enough || error_set(error, "no memory for the lists of a world");
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
        !own_lists(world, error) || !world_can(def, error) || !world_start(world, error)) {
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

void world_update_viscosities(World *world, double time)
{
    if (!world->constants.varies)
        return;
    world_def_at(&world->def, time);
    if (constants_vary(&world->constants, &world->def) && world->backend->vary)
        world->backend->vary(world->state);
}

/* Fills term columns missing in `known` (NULL: all) as unknown. */
static void clear_unknown(World *world, const ParticleColumns *known)
{
    for (const Term *const *term = shared_terms; *term; term++)
        if ((*term)->unknown && (*term)->needed(&world->constants) &&
            !(known && known->own[column_own((*term)->columns)]))
            world->backend->run(world->state, (*term)->unknown, &(PassInput){0});
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
    world->closed = flow_closed_gates(def);
    world_box_at(world, &world->filter, 0, &world->box);
    world_recompute_derived(world);
    start_method(world);
    clear_unknown(world, NULL);
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

/* Makes `def` the world's def; its constant part must equal the world's. Returns false with the reason,
   with nothing changed. */
static bool adopt(World *world, const WorldDef *def, Error *error)
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
    if (!adopt(world, &after, error))
        return false;
    energy_restart(world);
    world_update_viscosities(world, world_time_at(world, (double)world->step));
    return true;
}

bool world_keep_acceleration(World *world, Error *error)
{
    WorldDef def = world->def;
    def.acceleration = true;
    if (world->def.acceleration)
        return true;
    if (!adopt(world, &def, error))
        return false;
    clear_unknown(world, NULL);
    return !world_is_valid(world) || sentinel_mark(world, error); /* on trouble, the sentinel must go back
                                                                  first */
}

bool world_reload(World *world, Error *error)
{
    return !world->backend->reload || world->backend->reload(world->state, error);
}

void world_stop_at(World *world, double time)
{
    world->stop = time;
}

void world_solved_restart(World *world)
{
    world->tally = (SolveTally){0};
}

/* For a state without births, emitted particles have an unknown birth time. */
static bool take_births(World *world, const WorldState *state, Births *births)
{
    if (!births_copy(&state->births, births) || !births_reserve(births, 1))
        return false;
    if (births->count == 0 && state->numbers.emitted > 0)
        births_add(births, world->initial, NAN);
    return true;
}

bool world_load(World *world, const WorldState *state, Error *error)
{
    const WorldNumbers *numbers = &state->numbers;
    if (!world_state_check(world, state, error))
        return false;
    if (world->bodies && !bodies_are_valid(world->bodies, &numbers->bodies))
        return error_set(error, "the saved state does not say where the solids that float are");
    const WorldDef before = world->def;
    WorldDef def = before;
    Births births = {0};
    Error none;
    live_load(numbers->live, &def);
    if (!adopt(world, &def, error))
        return false;
    if (!take_births(world, state, &births) ||
        !world->backend->load(world->state, &state->particles, state->count, (size_t)numbers->guarded)) {
        births_free(&births);
        adopt(world, &before, &none);
        return error_set(error, "no memory for the state of %zu particles", state->count);
    }
    births_free(&world->births);
    world->births = births;
    world->step = (uint64_t)numbers->step;
    world->since_step = (uint64_t)numbers->since_step;
    world->since_time = numbers->since_time;
    world->stepping = numbers->stepping;
    world->target = numbers->target;
    world->filter = numbers->filter;
    world->box = numbers->box;
    world->finger = numbers->finger;
    world->closed = (uint64_t)numbers->closed;
    world->pours = numbers->pours;
    if (world->bodies)
        bodies_load(world->bodies, &numbers->bodies);
    world->energy = numbers->energy;
    world_update_viscosities(world, world_time_at(world, numbers->step));
    world_put_back(world, numbers, state->count);
    clear_unknown(world, &state->particles);
    return sentinel_mark(world, error);
}

/* The particles of a state as an initial state; false if memory is short. */
static bool as_initial(const WorldState *state, InitialState *initial)
{
    const ParticleColumns *p = &state->particles;
    float *position = malloc((3 * state->count + 1) * sizeof *position);
    *initial = (InitialState){.count = state->count, .position = position, .fluid = p->fluid};
    for (size_t i = 0; position && i < state->count; i++) {
        position[3 * i] = p->x[i];
        position[3 * i + 1] = p->y[i];
        position[3 * i + 2] = p->z[i];
    }
    return position;
}

/* True if the world's cells and columns fit the new box. Surplus cells change no bit: particles are found
   and summed by cells of a global lattice. Different columns would. */
static bool cells_hold(const Constants *constants, const WorldDef *def)
{
    const CellGrid *cells = &constants->cells;
    const double h = (double)constants->support_radius;
    bool hold = columns_wide(def) == constants->wide;
    for (int k = 0; k < def->dimensions; k++) {
        const double low = k == 1 ? 0 : -0.5 * def->box_size[k];
        hold &= def->periodic[k] || (low >= (cells->first[k] + 1) * h &&
                                     low + def->box_size[k] < (cells->first[k] + cells->size[k] - 1) * h);
    }
    return hold;
}

/* True if equal except for the hand's pose. */
static bool same_solid(const SolidDef *a, const SolidDef *b)
{
    bool same = a->kind == b->kind && a->radius == b->radius && a->height == b->height &&
                a->thickness == b->thickness && a->angle_deg == b->angle_deg && a->slip == b->slip &&
                a->mesh.shape == b->mesh.shape && a->mesh.scale == b->mesh.scale &&
                a->motion_count == b->motion_count && a->hand.moved == b->hand.moved &&
                a->density == b->density;
    for (int k = 0; k < 3; k++)
        same &= a->centre[k] == b->centre[k] && a->size[k] == b->size[k] && a->axis[k] == b->axis[k] &&
                a->hinge_at[k] == b->hinge_at[k] && a->hinge_axis[k] == b->hinge_axis[k];
    return same;
}

/* True if all resting solids are wholly in the box: otherwise a different box changes a solid's boundary. */
static bool is_around_solids(const WorldDef *def)
{
    bool around = true;
    for (int i = 0; i < def->solid_count; i++)
        for (int k = 0; k < def->dimensions && !solid_moves(&def->solids[i]); k++) {
            const double low = k == 1 ? 0 : -0.5 * def->box_size[k];
            around &= solid_between(&def->solids[i], def->dimensions, k, low, low + def->box_size[k]);
        }
    return around;
}

bool world_resizes(const World *world, const WorldDef *def)
{
    bool same = world->def.solid_count == def->solid_count;
    for (int i = 0; same && i < def->solid_count; i++)
        same = same_solid(&world->def.solids[i], &def->solids[i]);
    return same && is_around_solids(&world->def) && is_around_solids(def) &&
           cells_hold(&world->constants, def);
}

/* Moves particles into a box that became smaller along an axis. */
static void bring_in(WorldState *state, const WorldDef *def, int axis)
{
    assert(axis < 3);
    const ParticleColumns *p = &state->particles;
    float *const along[] = {p->x, p->y, p->z};
    const float slack = 1e-3F * (float)def->spacing;
    const float low = axis == 1 ? 0 : -0.5F * (float)def->box_size[axis],
                high = low + (float)def->box_size[axis];
    float *left = p->own[COLUMNS_LEFT + axis];
    for (size_t i = 0; i < state->count; i++) {
        const float x = along[axis][i];
        along[axis][i] = fmaxf(low + slack, fminf(x, high - slack));
        if (left && along[axis][i] != x)
            left[i] = 0;
    }
}

static void place_box(World *world, const double size[3])
{
    WorldDef *def = &world->def;
    memcpy(def->box_size, size, sizeof def->box_size);
    walls_place(&world->constants.walls, def->dimensions, size, def->periodic, def->spacing);
    for (int k = 0; k < 3; k++)
        world->constants.drag.half_size[k] = world->constants.walls.half_size[k];
}

static void set_solids(World *world, const SolidDef solids[SOLIDS_MAX])
{
    memcpy(world->def.solids, solids, sizeof world->def.solids);
    memcpy(world->constants.solids, solids, sizeof world->constants.solids);
}

/* Takes effect with the next step; particles outside of a smaller box move to the walls. */
static bool world_resize(World *world, const WorldDef *def, Error *error)
{
    WorldState state = {.count = 0};
    const WorldDef before = world->def;
    if (!world_save(world, &state, error))
        return false;
    for (int k = 0; k < def->dimensions; k++)
        if (def->box_size[k] < before.box_size[k])
            bring_in(&state, def, k);
    place_box(world, def->box_size);
    set_solids(world, def->solids);
    const bool loaded = world_load(world, &state, error);
    if (loaded)
        world_pose(world); /* the box turns about half its height */
    else {
        place_box(world, before.box_size);
        set_solids(world, before.solids);
    }
    world_state_free(&state);
    return loaded && sentinel_mark(world, error);
}

/* Copies data that no state holds. */
static bool inherit(World *to, const World *from, Error *error)
{
    if (from->forces_wanted && !world_enable_forces(to, error))
        return false;
    to->forces = from->forces;
    to->forces_before = from->forces; /* going back leads to the present state */
    to->trouble = from->trouble;
    to->tally = from->tally;
    to->stop = from->stop;
    memcpy(to->limited, from->limited, sizeof to->limited);
    return true;
}

/* Makes a world of `def` in `state` that continues `from`. NULL with the reason. */
static World *made_with(const World *from, const WorldDef *def, const WorldState *state, Error *error)
{
    InitialState initial;
    WorldDef own = *def;
    World *to = NULL;
    own.initial = &initial;
    if (as_initial(state, &initial)) {
        initial.capacity = from->capacity;
        to = world_create(&own, error);
    } else {
        error_set(error, "no memory for %zu particles", state->count);
    }
    if (to)
        to->initial = from->initial;
    const bool ok = to && world_load(to, state, error) && inherit(to, from, error);
    free((float *)initial.position);
    if (ok)
        return to;
    world_destroy(to);
    return NULL;
}

/* The index of the only solid of `before` missing in `after`; -1: any other change. */
static int taken_out(const WorldDef *before, const WorldDef *after)
{
    int k = 0;
    bool same = after->solid_count == before->solid_count - 1;
    while (k < after->solid_count && same_solid(&before->solids[k], &after->solids[k]))
        k++;
    for (int i = k; i < after->solid_count; i++)
        same &= same_solid(&before->solids[i + 1], &after->solids[i]);
    return same ? k : -1;
}

/* Orders the states of floating solids by the numbers in `def`; new solids rest at the places of `def`. */
static void renumber_bodies(const WorldDef *before, const WorldDef *def, BodyStates *states)
{
    const BodyStates old = *states;
    const int taken = taken_out(before, def);
    memset(states, 0, sizeof *states);
    for (int k = 0; k < def->solid_count; k++) {
        const int from = k + (taken >= 0 && k >= taken);
        if (!solid_floats(&def->solids[k]))
            continue;
        if (from < before->solid_count && solid_floats(&before->solids[from]))
            states->of[k] = old.of[from];
        else
            solid_pose(&def->solids[k], 0, &states->of[k].pose);
    }
}

/* Rebuilds the world from a def with a different backend, solids, box or pouring; continues from the same
   state and replaces *world. Takes about as long as world_create, with twice the memory in the meantime.
   Returns false with the reason, with nothing changed. */
static bool world_rebuild(World **world, const WorldDef *def, Error *error)
{
    World *from = *world;
    WorldState state = {.count = 0};
    const bool saved = world_save(from, &state, error);
    for (int k = 0; saved && k < def->dimensions; k++)
        if (def->box_size[k] < from->def.box_size[k])
            bring_in(&state, def, k);
    renumber_bodies(&from->def, def, &state.numbers.bodies);
    World *to = saved ? made_with(from, def, &state, error) : NULL;
    world_state_free(&state);
    if (to && def->box_size[1] != from->def.box_size[1]) { /* the box turns about half its height */
        world_pose(to);
        if (!sentinel_mark(to, error)) {
            world_destroy(to);
            return false;
        }
    }
    if (!to)
        return false;
    world_destroy(from);
    *world = to;
    return true;
}

bool world_move(World **world, const char *backend, Error *error)
{
    WorldDef def = (*world)->def;
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    return world_rebuild(world, &def, error);
}

/* The world's def with box and solids of `from`. *all_same: true if box and solids were the same, except for
   the hand's poses. Returns false with the reason if memory is short. */
static bool with_shapes(const World *world, const WorldDef *from, WorldDef *def, bool *all_same, Error *error)
{
    *def = world->def;
    bool same = def->solid_count == from->solid_count;
    for (int i = 0; i < from->solid_count; i++)
        same &= same_solid(&def->solids[i], &from->solids[i]);
    def->solid_count = from->solid_count;
    memcpy(def->solids, from->solids, sizeof def->solids);
    for (int k = 0; k < def->dimensions; k++) {
        same &= def->box_size[k] == from->box_size[k];
        def->box_size[k] = from->box_size[k];
    }
    *all_same = same;
    return own_motions(def->solids, def->solid_count) ||
           error_set(error, "no memory for the motions of the solids");
}

/* Renumbers the forces on solids after the removed solid. */
static void close_gap(Forces *forces, int taken)
{
    Push *at = forces->solid + taken;
    memmove(at, at + 1, (size_t)(SOLIDS_MAX - 1 - taken) * sizeof *at);
    forces->solid[SOLIDS_MAX - 1] = (Push){0};
}

bool world_set_shapes(World **world, const WorldDef *from, Error *error)
{
    WorldDef def;
    bool same;
    if (!with_shapes(*world, from, &def, &same, error))
        return false;
    const int taken = taken_out(&(*world)->def, from);
    const bool set = same || (world_resizes(*world, &def) ? world_resize(*world, &def, error)
                                                          : world_rebuild(world, &def, error));
    if (same)
        set_solids(*world, def.solids);
    if (set && taken >= 0) {
        close_gap(&(*world)->forces, taken);
        close_gap(&(*world)->forces_before, taken);
    }
    energy_restart(*world);
    return set;
}

bool world_load_shapes(World **world, const WorldDef *from, const WorldState *state, Error *error)
{
    WorldDef def;
    SolidDef before[SOLIDS_MAX];
    bool same;
    if (!with_shapes(*world, from, &def, &same, error))
        return false;
    if (!same) { /* the present state is not needed and may be unsound */
        World *to = made_with(*world, &def, state, error);
        if (!to)
            return false;
        world_destroy(*world);
        *world = to;
        return true;
    }
    memcpy(before, (*world)->def.solids, sizeof before);
    set_solids(*world, def.solids);
    if (world_load(*world, state, error))
        return true;
    set_solids(*world, before);
    return false;
}

bool world_make_room(World **world, Error *error)
{
    WorldDef def = (*world)->def;
    def.pours = true;
    return (*world)->constants.emits || world_rebuild(world, &def, error);
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
    energy_restart(world);
}

void world_carry_box(World *world, const BoxTarget *target)
{
    if (!target_take(world, target))
        return;
    energy_restart(world);
    world->filter = box_filter_at_rest();
    memcpy(world->filter.position, world->target.position, sizeof world->filter.position);
    memcpy(world->filter.orientation, world->target.orientation, sizeof world->filter.orientation);
    world_box_at(world, &world->filter, world_time_at(world, (double)world->step), &world->box);
}
