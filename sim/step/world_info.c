/* What a world tells. */
#include "sim/base/base.h"
#include "sim/solids/solid.h"
#include "sim/step/world.h"
#include "sim/world.h"

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

bool world_on_gpu(const WorldDef *def)
{
    const Backend *backend = backend_find(def->backend);
    return backend && backend->gpu;
}

/* By multiplication, not by summing: for a constant dt, a step's time depends on its number alone. */
double world_time_at(const World *world, double step)
{
    return world->since_time + (step - (double)world->since_step) * world->stepping.dt;
}

void world_box_at(const World *world, const BoxFilter *filter, double time, BoxState *box)
{
    box_state_at(world->def.motions, world->def.motion_count, world->def.box_size[1], time, box);
    box_filter_apply(filter, world->def.box_size[1], box);
}

void world_pose(World *world)
{
    world_box_at(world, &world->filter, world_time_at(world, (double)world->step), &world->box);
}

/* As WorldInfo.blocked. */
static uint64_t world_blocked(const World *world)
{
    uint64_t gates = 0;
    for (int k = 0; k < EMITTERS_MAX; k++)
        gates |= (uint64_t)(world->blocked[k] == BLOCKED_LAYERS) << k;
    return gates;
}

size_t world_held(const World *world)
{
    return world->backend->held ? world->backend->held(world->state) : world->count;
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
        .blocked = world_blocked(world),
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
    const size_t count = world_held(world);
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

typedef struct IdPlace {
    ParticleId id;
    size_t place;
} IdPlace;

static int ascending(const void *a, const void *b)
{
    const ParticleId x = ((const IdPlace *)a)->id, y = ((const IdPlace *)b)->id;
    return (x > y) - (x < y);
}

uint64_t world_hash(World *world)
{
    WorldInfo info;
    world_info(world, &info);
    const size_t n = info.count;
    ParticleArrays out = {
        .position = malloc((n + 1) * 4 * sizeof(float)),
        .velocity = malloc((n + 1) * 4 * sizeof(float)),
        .whole_id = malloc((n + 1) * sizeof(ParticleId)),
    };
    IdPlace *order = malloc((n + 1) * sizeof *order);
    uint64_t hash = 0;
    if (out.position && out.velocity && out.whole_id && order && world_read(world, &out)) {
        for (size_t i = 0; i < n; i++)
            order[i] = (IdPlace){out.whole_id[i], i};
        qsort(order, n, sizeof *order, ascending);
        hash = HASH_NONE;
        for (size_t k = 0; k < n; k++) {
            const size_t i = order[k].place;
            hash = hash_add(hash, &out.position[4 * i], 3 * sizeof(float));
            hash = hash_add(hash, &out.velocity[4 * i], 3 * sizeof(float));
        }
        for (int k = 0; k < world->def.solid_count; k++)
            if (solid_floats(&world->def.solids[k]))
                hash = hash_add(hash, &info.floating[k], sizeof info.floating[k]);
    }
    free(out.position);
    free(out.velocity);
    free(out.whole_id);
    free(order);
    return hash;
}
