#include "sim/base/key.h"
#include "sim/solids/bodies.h"
#include "sim/step/method.h"
#include "sim/step/sentinel.h"
#include "sim/step/world.h"
#include "slosh/state.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Rebuilds the world from a def with a different backend, solids, box or pouring; continues from the same
   state and replaces *world. Takes about as long as world_create, with twice the memory in the meantime.
   Returns false with the reason, with nothing changed. */
static bool world_rebuild(World **world, const WorldDef *def, Error *error);

extern const Key box_keys[], solver_keys[], step_keys[], fluid_keys[]; /* sim/def */
extern const Key hand_keys[];                                          /* sim/box */

/* Key rows and the offset of their struct in a WorldDef. The saved state keeps this order. */
static const struct {
    const Key *rows;
    size_t at;
} groups[] = {
    {box_keys, 0}, {solver_keys, 0}, {step_keys, 0}, {hand_keys, offsetof(WorldDef, limits)}, {fluid_keys, 0},
};

enum { MEMBERS_MAX = 64 };

/* A member of the def, filled by a row: contiguous numbers. */
typedef struct Member {
    const Key *key, *list; /* the row; the list with the member in its elements, or NULL */
    KeyType type;
    int numbers;
    size_t at; /* offset in a WorldDef; for a list, of the first element */
} Member;

typedef struct Members {
    int count;
    Member of[MEMBERS_MAX];
} Members;

static void add(Members *members, const Member *member)
{
    assert(members->count < MEMBERS_MAX);
    members->of[members->count++] = *member;
}

/* A row with a table gives two members: the number and the table. */
static void add_row(Members *members, const Key *key, const Key *list, size_t at)
{
    Member member = {.key = key, .list = list, .type = key->type, .numbers = key->type == KEY_VEC3 ? 3 : 1};
    const size_t base = at + (list ? list->offset : 0);
    member.at = base + key->offset;
    add(members, &member);
    if (key->type != KEY_CURVE)
        return;
    member.at = base + key->aux;
    member.numbers = sizeof(TimeTable) / sizeof(double);
    add(members, &member);
}

static Members members_of_rows(void)
{
    Members members = {.count = 0};
    for (size_t g = 0; g < sizeof groups / sizeof *groups; g++) {
        const Key *list = NULL;
        for (const Key *key = groups[g].rows; key->path; key++) {
            if (key->type == KEY_LIST && !strstr(key->path, "[]"))
                list = key;
            if (key->flags & KEY_LIVE && !(key->flags & KEY_IDLE))
                add_row(&members, key, strstr(key->path, "[]") ? list : NULL, groups[g].at);
        }
    }
    return members;
}

static int room_for(const Member *member)
{
    return member->list ? (int)member->list->max : 1;
}

static int elements_in(const Member *member, const WorldDef *def)
{
    const char *base = (const char *)def;
    return member->list ? *(const int *)(const void *)(base + member->list->aux) : 1;
}

static size_t member_offset(const Member *member, int element)
{
    return member->at + (member->list ? (size_t)element * member->list->size : 0);
}

static double get(const Member *member, const void *field, int k)
{
    switch (member->type) {
    case KEY_BOOLEAN:
        return ((const bool *)field)[k];
    case KEY_INTEGER:
    case KEY_CHOICE:
        return ((const int *)field)[k];
    default:
        return ((const double *)field)[k];
    }
}

static void put(const Member *member, void *field, int k, double number)
{
    switch (member->type) {
    case KEY_BOOLEAN:
        ((bool *)field)[k] = number != 0;
        break;
    case KEY_INTEGER:
    case KEY_CHOICE:
        ((int *)field)[k] = (int)number;
        break;
    default:
        ((double *)field)[k] = number;
    }
}

void live_save(const WorldDef *def, double numbers[LIVE_NUMBERS])
{
    const Members members = members_of_rows();
    for (const Member *m = members.of; m < members.of + members.count; m++) {
        for (int e = 0; e < elements_in(m, def); e++)
            for (int k = 0; k < m->numbers; k++)
                numbers[e * m->numbers + k] = get(m, (const char *)def + member_offset(m, e), k);
        numbers += room_for(m) * m->numbers;
    }
}

void live_load(const double numbers[LIVE_NUMBERS], WorldDef *def)
{
    const Members members = members_of_rows();
    for (const Member *m = members.of; m < members.of + members.count; m++) {
        for (int e = 0; e < elements_in(m, def); e++)
            for (int k = 0; k < m->numbers; k++)
                put(m, (char *)def + member_offset(m, e), k, numbers[e * m->numbers + k]);
        numbers += room_for(m) * m->numbers;
    }
}

static void copy_rows(const Key *rows, const char *from, char *to)
{
    for (const Key *key = rows; key && key->path; key++) {
        Members members = {.count = 0};
        if (key->flags & KEY_LIVE)
            add_row(&members, key, NULL, 0);
        for (const Member *m = members.of; m < members.of + members.count; m++)
            for (int k = 0; k < m->numbers; k++)
                put(m, to + m->at, k, get(m, from + m->at, k));
    }
}

void live_copy(const WorldDef *from, WorldDef *to)
{
    double numbers[LIVE_NUMBERS] = {0};
    live_save(from, numbers);
    live_load(numbers, to);
    for (const Method *const *m = method_list(); *m; m++)
        copy_rows((*m)->keys, method_def(from, *m), method_def(to, *m));
}

/* True if each integer setting is an integer and not below its row's minimum. */
static bool live_is_valid(const double numbers[LIVE_NUMBERS])
{
    const Members members = members_of_rows();
    for (const Member *m = members.of; m < members.of + members.count; m++) {
        const bool whole = m->type == KEY_INTEGER || m->type == KEY_CHOICE;
        for (int k = 0; whole && k < room_for(m) * m->numbers; k++)
            if (!(numbers[k] >= m->key->min && numbers[k] < 0x1p31))
                return false;
        numbers += room_for(m) * m->numbers;
    }
    return true;
}

int live_count(void)
{
    const Members members = members_of_rows();
    int count = 0;
    for (const Member *m = members.of; m < members.of + members.count; m++)
        count += room_for(m) * m->numbers;
    return count;
}

void world_state_free(WorldState *state)
{
    columns_destroy(&state->particles);
    births_free(&state->births);
    *state = (WorldState){.count = 0};
}

bool world_state_reserve(WorldState *state, const WorldDef *def, size_t count)
{
    const ColumnRows saved = columns_saved(def);
    const Method *method = method_find(def->method);
    if (count > state->capacity || state->method != method)
        world_state_free(state);
    state->method = method;
    state->capacity = count > state->capacity ? count : state->capacity;
    state->count = count;
    state->births.count = 0;
    if (columns_create(&state->particles, &saved, state->capacity, NULL))
        return true;
    world_state_free(state);
    return false;
}

size_t world_births_bytes(const World *world)
{
    return world->births.count * sizeof(Birth);
}

/* Saves the live keys with the viscosities of `time`. Without a copy of the def, which is large: the
   sentinel saves several times a second. */
static void save_live(World *world, double time, double numbers[LIVE_NUMBERS])
{
    WorldDef *def = &world->def;
    double viscosity[FLUIDS_MAX] = {0};
    for (int f = 0; f < def->fluid_count; f++)
        viscosity[f] = def->fluids[f].viscosity;
    world_def_at(def, time);
    live_save(def, numbers);
    for (int f = 0; f < def->fluid_count; f++)
        def->fluids[f].viscosity = viscosity[f];
}

void world_save_numbers(World *world, WorldNumbers *numbers)
{
    WorldInfo info;
    world_is_valid(world);
    world_info(world, &info);
    *numbers = (WorldNumbers){
        .version = WORLD_STATE_VERSION,
        .step = (double)world->step,
        .since_step = (double)world->since_step,
        .since_time = world->since_time,
        .guarded = (double)info.guarded,
        .emitted = (double)world->emitted,
        .drained = (double)world->drained,
        .stepping = world->stepping,
        .target = world->target,
        .filter = world->filter,
        .box = world->box,
        .energy = world->energy,
        .finger = world->finger,
        .shut = (double)world->shut,
        .pours = world->pours,
    };
    save_live(world, info.time, numbers->live);
    if (world->bodies)
        bodies_save(world->bodies, &numbers->bodies);
}

static bool not_sound(const World *world, Error *error)
{
    WorldTrouble seen = world->trouble; /* with the solver, if a solver is in trouble */
    char words[160];
    seen.what = world->seen;
    world_trouble_words(&seen, words);
    return error_set(error,
                     "the state at t = %g s is not sound: %s; go on until the simulation has gone back",
                     world_time_at(world, (double)world->step), words);
}

bool world_save(World *world, WorldState *state, Error *error)
{
    if (!world_is_valid(world))
        return not_sound(world, error);
    if (!world_state_reserve(state, &world->def, world->count) ||
        !births_copy(&world->births, &state->births) ||
        !world->backend->save(world->state, &state->particles))
        return error_set(error, "no memory for the state of %zu particles", world->count);
    world_save_numbers(world, &state->numbers);
    return true;
}

static bool numbers_check(const WorldNumbers *numbers, Error *error)
{
    double all[WORLD_NUMBERS];
    memcpy(all, numbers, sizeof all);
    if (numbers->version != WORLD_STATE_VERSION)
        return error_set(error, "a saved state of version %g; this is version %d", numbers->version,
                         WORLD_STATE_VERSION);
    for (int i = 0; i < WORLD_NUMBERS; i++)
        if (!isfinite(all[i]))
            return error_set(error, "the saved state is damaged: a number of it is not finite");
    if (!(numbers->step >= numbers->since_step && numbers->since_step >= 0 && numbers->step < 0x1p53 &&
          numbers->stepping.dt > 0 && numbers->stepping.refine >= 1 && numbers->stepping.limit >= 0 &&
          numbers->stepping.limit < STEP_LIMIT_COUNT && live_is_valid(numbers->live) &&
          finger_sound(&numbers->finger) && numbers->shut >= 0 && numbers->shut < 0x1p40 &&
          numbers->guarded >= 0 && numbers->emitted >= 0 && numbers->emitted < 0x1p53 &&
          numbers->drained >= 0))
        return error_set(error, "the saved state is damaged: its steps do not count");
    return true;
}

/* True if the method's kept columns of particle i are finite. */
static bool own_finite(const ParticleColumns *p, size_t i)
{
    bool finite = true;
    for (int k = 0; k < COLUMNS_SHOWN; k++)
        finite &= !p->own[k] || isfinite(p->own[k][i]);
    return finite;
}

static int ascending(const void *a, const void *b)
{
    const ParticleId one = *(const ParticleId *)a, other = *(const ParticleId *)b;
    return (one > other) - (one < other);
}

/* True if each id occurs once and is below `end`; *known: false if memory is short. */
static bool ids_differ(const ParticleId *id, size_t count, double end, bool *known)
{
    ParticleId *sorted = malloc((count + 1) * sizeof *sorted);
    bool differ = *known = sorted != NULL;
    if (sorted && count > 0)
        memcpy(sorted, id, count * sizeof *sorted);
    if (sorted && count > 1)
        qsort(sorted, count, sizeof *sorted, ascending);
    for (size_t i = 0; i + 1 < count && differ; i++)
        differ = sorted[i] != sorted[i + 1];
    differ = differ && (count == 0 || (double)sorted[count - 1] < end);
    free(sorted);
    return differ;
}

/* The same, faster if nearly all particles ever born are present. */
static bool ids_are_dense(const ParticleId *id, size_t count, double end, bool *known)
{
    bool *seen = calloc((size_t)end + 1, sizeof *seen), differ = *known = seen != NULL;
    for (size_t i = 0; i < count && differ; i++) {
        differ = (double)id[i] < end && !seen[id[i]];
        if (differ)
            seen[id[i]] = true;
    }
    free(seen);
    return differ;
}

/* Checks for unique ids and finite numbers. */
static bool particles_check(const World *world, const WorldState *state, Error *error)
{
    const WorldNumbers *numbers = &state->numbers;
    const double born = (double)world->initial + numbers->emitted;
    if ((double)state->count != born - numbers->drained || state->count > world->capacity)
        return error_set(error, "the saved state has %zu particles, the scene %zu", state->count,
                         world->count);
    const ParticleColumns *p = &state->particles;
    if (!world_names(world, (uint64_t)born, error))
        return false;
    bool known;
    bool whole = born < 8 * (double)state->count ? ids_are_dense(p->id, state->count, born, &known)
                                                 : ids_differ(p->id, state->count, born, &known);
    if (!known)
        return error_set(error, "no memory");
    for (size_t i = 0; i < state->count && whole; i++) {
        whole = isfinite(p->x[i] + p->y[i] + p->z[i] + p->vx[i] + p->vy[i] + p->vz[i]) && own_finite(p, i) &&
                (!p->compression || (p->compression[i] > -1 && isfinite(p->compression[i]))) &&
                p->fluid[i] < world->def.fluid_count;
    }
    return whole || error_set(error, "the saved state is damaged: its particles are not those of the scene");
}

void world_put_back(World *world, const WorldNumbers *numbers, size_t count)
{
    world->kicked = false;
    world->seen = STEP_TROUBLE_NONE;
    for (int k = 0; k < SOLVES_MAX; k++)
        world->solves[k].failed = false;
    world->count = count;
    world->emitted = (uint64_t)numbers->emitted;
    world->drained = (uint64_t)numbers->drained;
    births_cut(&world->births, world->initial + world->emitted);
    world_recompute_derived(world);
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
    if (!numbers_check(numbers, error) || !particles_check(world, state, error))
        return false;
    if (world->bodies && !bodies_are_valid(world->bodies, &numbers->bodies))
        return error_set(error, "the saved state does not say where the solids that float are");
    const WorldDef before = world->def;
    WorldDef def = before;
    Births births = {0};
    Error none;
    live_load(numbers->live, &def);
    if (!world_adopt(world, &def, error))
        return false;
    if (!take_births(world, state, &births) ||
        !world->backend->load(world->state, &state->particles, state->count, (size_t)numbers->guarded)) {
        births_free(&births);
        world_adopt(world, &before, &none);
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
    world->shut = (uint64_t)numbers->shut;
    world->pours = numbers->pours;
    if (world->bodies)
        bodies_load(world->bodies, &numbers->bodies);
    world->energy = numbers->energy;
    world_update_viscosities(world, world_time_at(world, numbers->step));
    world_put_back(world, numbers, state->count);
    world_clear_unknown(world, &state->particles);
    return sentinel_mark(world, error);
}

bool world_move(World **world, const char *backend, Error *error)
{
    WorldDef def = (*world)->def;
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    return world_rebuild(world, &def, error);
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
    if (from->feels && !world_enable_forces(to, error))
        return false;
    to->felt = from->felt;
    to->felt_before = from->felt; /* going back leads to the present state */
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
        initial.room = from->capacity;
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

static bool world_rebuild(World **world, const WorldDef *def, Error *error)
{
    World *from = *world;
    WorldState state = {.count = 0};
    const bool saved = world_save(from, &state, error);
    for (int k = 0; saved && k < def->dimensions; k++)
        if (def->box_size[k] < from->def.box_size[k])
            bring_in(&state, def, k);
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

/* The world's def with box and solids of `from`. Returns true if box and solids were the same, except for
   the hand's poses. */
static bool with_shapes(const World *world, const WorldDef *from, WorldDef *def)
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
    return same;
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

/* Renumbers the forces on solids after the removed solid. */
static void close_gap(Forces *felt, int taken)
{
    Push *at = felt->solid + taken;
    memmove(at, at + 1, (size_t)(SOLIDS_MAX - 1 - taken) * sizeof *at);
    felt->solid[SOLIDS_MAX - 1] = (Push){0};
}

bool world_set_shapes(World **world, const WorldDef *from, Error *error)
{
    WorldDef def;
    const bool same = with_shapes(*world, from, &def);
    const int taken = taken_out(&(*world)->def, from);
    const bool set = same || (world_resizes(*world, &def) ? world_resize(*world, &def, error)
                                                          : world_rebuild(world, &def, error));
    if (same)
        set_solids(*world, from->solids);
    if (set && taken >= 0) {
        close_gap(&(*world)->felt, taken);
        close_gap(&(*world)->felt_before, taken);
    }
    energy_forget(*world);
    return set;
}

bool world_load_shapes(World **world, const WorldDef *from, const WorldState *state, Error *error)
{
    WorldDef def;
    SolidDef before[SOLIDS_MAX];
    if (!with_shapes(*world, from, &def)) { /* the present state is not needed and may be unsound */
        World *to = made_with(*world, &def, state, error);
        if (!to)
            return false;
        world_destroy(*world);
        *world = to;
        return true;
    }
    memcpy(before, (*world)->def.solids, sizeof before);
    set_solids(*world, from->solids);
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
