#include "sim/base/key.h"
#include "sim/solids/solid.h"
#include "sim/state.h"
#include "sim/step/method.h"
#include "sim/step/world.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
typedef struct DefMember {
    const Key *key, *list; /* the row; the list with the member in its elements, or NULL */
    KeyType type;
    int numbers;
    size_t at; /* offset in a WorldDef; for a list, of the first element */
} DefMember;

typedef struct DefMembers {
    int count;
    DefMember of[MEMBERS_MAX];
} DefMembers;

static void add(DefMembers *members, const DefMember *member)
{
    assert(members->count < MEMBERS_MAX);
    members->of[members->count++] = *member;
}

/* A row with a table gives two members: the number and the table. */
static void add_row(DefMembers *members, const Key *key, const Key *list, size_t at)
{
    DefMember member = {
        .key = key, .list = list, .type = key->type, .numbers = key->type == KEY_VEC3 ? 3 : 1};
    const size_t base = at + (list ? list->offset : 0);
    member.at = base + key->offset;
    add(members, &member);
    if (key->type != KEY_CURVE)
        return;
    member.at = base + key->aux;
    member.numbers = sizeof(TimeTable) / sizeof(double);
    add(members, &member);
}

static DefMembers members_of_rows(void)
{
    DefMembers members = {.count = 0};
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

static int room_for(const DefMember *member)
{
    return member->list ? (int)member->list->max : 1;
}

static int elements_in(const DefMember *member, const WorldDef *def)
{
    const char *base = (const char *)def;
    return member->list ? *(const int *)(const void *)(base + member->list->aux) : 1;
}

static size_t member_offset(const DefMember *member, int element)
{
    return member->at + (member->list ? (size_t)element * member->list->size : 0);
}

static double get(const DefMember *member, const void *field, int k)
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

static void put(const DefMember *member, void *field, int k, double number)
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
    const DefMembers members = members_of_rows();
    for (const DefMember *m = members.of; m < members.of + members.count; m++) {
        for (int e = 0; e < elements_in(m, def); e++)
            for (int k = 0; k < m->numbers; k++)
                numbers[e * m->numbers + k] = get(m, (const char *)def + member_offset(m, e), k);
        numbers += room_for(m) * m->numbers;
    }
}

void live_load(const double numbers[LIVE_NUMBERS], WorldDef *def)
{
    const DefMembers members = members_of_rows();
    for (const DefMember *m = members.of; m < members.of + members.count; m++) {
        for (int e = 0; e < elements_in(m, def); e++)
            for (int k = 0; k < m->numbers; k++)
                put(m, (char *)def + member_offset(m, e), k, numbers[e * m->numbers + k]);
        numbers += room_for(m) * m->numbers;
    }
}

static void copy_rows(const Key *rows, const char *from, char *to)
{
    for (const Key *key = rows; key && key->path; key++) {
        DefMembers members = {.count = 0};
        if (key->flags & KEY_LIVE)
            add_row(&members, key, NULL, 0);
        for (const DefMember *m = members.of; m < members.of + members.count; m++)
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
    const DefMembers members = members_of_rows();
    for (const DefMember *m = members.of; m < members.of + members.count; m++) {
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
    const DefMembers members = members_of_rows();
    int count = 0;
    for (const DefMember *m = members.of; m < members.of + members.count; m++)
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
    if (world->bodies)
        bodies_end_owed(world->bodies, world->backend, world->state);
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
        .closed = (double)world->closed,
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

/* `saving`: NULL to wait. */
static bool save_particles(World *world, WorldState *state, WorldSaving *saving)
{
    const Backend *backend = world->backend;
    if (!saving || !backend->copies)
        return backend->save(world->state, &state->particles);
    if (saving->by != backend->copies)
        world_save_end(saving);
    saving->by = backend->copies;
    if (!backend->copies->begin(world->state, &state->particles, &saving->copy))
        return false;
    saving->to = state;
    return true;
}

static bool save(World *world, WorldState *state, WorldSaving *saving, Error *error)
{
    if (!world_is_valid(world))
        return not_sound(world, error);
    if (!world_state_reserve(state, &world->def, world->count) ||
        !births_copy(&world->births, &state->births) || !save_particles(world, state, saving))
        return error_set(error, "no memory for the state of %zu particles", world->count);
    world_save_numbers(world, &state->numbers);
    return true;
}

bool world_save(World *world, WorldState *state, Error *error)
{
    return save(world, state, NULL, error);
}

bool world_save_begin(World *world, WorldState *state, WorldSaving *saving, Error *error)
{
    saving->to = NULL;
    return save(world, state, saving, error);
}

bool world_save_go_on(WorldSaving *saving, bool waits)
{
    bool whole = true;
    const bool answered =
        !saving->to || saving->by->go_on(saving->copy, &saving->to->particles, waits, &whole);
    if (whole || !answered)
        saving->to = NULL;
    return answered;
}

void world_save_end(WorldSaving *saving)
{
    if (saving->by)
        saving->by->free(saving->copy);
    *saving = (WorldSaving){.to = NULL};
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
          finger_sound(&numbers->finger) && numbers->closed >= 0 && numbers->closed < 0x1p40 &&
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

bool world_state_check(const World *world, const WorldState *state, Error *error)
{
    return numbers_check(&state->numbers, error) && particles_check(world, state, error);
}
