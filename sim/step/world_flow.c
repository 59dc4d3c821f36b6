#include "sim/base/base.h"
#include "sim/solids/solid.h"
#include "sim/step/world.h"

#include <stdlib.h>
#include <string.h>

/* Cheaper to keep than to check: the check reads ids back from a GPU. A birth has 16 bytes in each state. */
static size_t births_few(const World *world)
{
    return world->backend->gpu ? 16384 : 256;
}

/* Direction of gravity in the box; without gravity, down. */
static void falls(const World *world, double direction[3])
{
    quat_rotate_inverse(world->box.orientation, world->def.gravity, direction);
    if (world->def.dimensions == 2)
        direction[2] = 0;
    if (!(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2] > 1e-6))
        direction[0] = direction[2] = 0, direction[1] = -1;
}

bool world_pours(const World *world, Emit *emit, int *fluid)
{
    const FingerState *finger = &world->finger;
    *fluid = finger_on(finger) ? finger_fluid(&finger->wanted) : -1;
    if (*fluid < 0 || *fluid >= world->def.fluid_count || !world->constants.emits)
        return false;
    *emit = (Emit){.radius = finger->wanted.radius, .speed = finger->wanted.strength, .start = world->pours};
    memcpy(emit->centre, finger->point, sizeof emit->centre);
    falls(world, emit->direction);
    return true;
}

/* Makes room for a layer of the emitter; false if memory is short. */
static bool layer_reserve(World *world, const Emit *emit)
{
    const size_t most = emit_most(emit, world->def.dimensions, world->def.spacing);
    if (most <= world->layer_capacity)
        return true;
    float *more = realloc(world->layer, 3 * most * sizeof *more);
    world->layer = more ? more : world->layer;
    world->layer_capacity = more ? most : world->layer_capacity;
    return more;
}

/* Counts consecutive layers without room for any particle. An emitter that waits for the world's particle
   limit does not count. */
static void look_for_room(unsigned short *blocked, size_t came, bool full)
{
    if (came > 0 || full)
        *blocked = 0;
    else if (*blocked < BLOCKED_LAYERS)
        ++*blocked;
}

static void layer_came(World *world, const Flow *flow, size_t number)
{
    if (flow->blocked)
        look_for_room(flow->blocked, number, world->count == world->capacity);
    if (number > 0)
        births_add(&world->births, world->initial + world->emitted, flow->born);
    world->emitted += number;
    world->count += number;
}

static void drained(World *world, size_t number)
{
    world->drained += number;
    world->count -= number;
}

bool world_finish(World *world)
{
    size_t flowed[FLOWS_MAX];
    if (!world->backend->finish)
        return true;
    const bool good = world->backend->finish(world->state, world->bodies && world->method->leaps, flowed);
    for (int k = 0; good && k < world->flow_count; k++)
        if (world->flows[k].drains)
            drained(world, flowed[k]);
        else
            layer_came(world, &world->flows[k], flowed[k]);
    world->flow_count = 0;
    return good;
}

/* Flow number FLOWS_MAX of a step waits for the numbers. */
static void flow_later(World *world, Flow flow)
{
    world->flows[world->flow_count++] = flow;
    if (world->flow_count == FLOWS_MAX)
        world_finish(world);
}

/* `blocked`: the emitter's counter; NULL for poured fluid. */
static void let_in(World *world, int fluid, const Emit *emit, unsigned short *blocked, double begin,
                   double end)
{
    const WorldDef *def = &world->def;
    long first;
    const long layers = emit_layers(emit, def->spacing, begin, end, &first);
    for (long k = first; k < first + layers; k++) {
        const uint64_t born = world->initial + world->emitted;
        EmitLayer layer = {.position = world->layer, .fluid = fluid, .first_id = born};
        if (k == first)
            world->backend->grid(world->state); /* present positions */
        emit_place(emit, def->dimensions, def->spacing, k, end, &layer);
        for (size_t i = 0; i < layer.count; i++)
            periodic_wrap(&world->constants.periodic, layer.position + 3 * i, NULL);
        const Flow flow = {.blocked = layer.count > 0 ? blocked : NULL,
                           .born = (float)emit_time(emit, def->spacing, k)};
        const size_t more = world->backend->emit(world->state, &layer, world->capacity - world->count);
        if (more == FLOW_LATER) {
            flow_later(world, flow);
            continue;
        }
        energy_add_emitted(world, &layer, more);
        layer_came(world, &flow, more);
    }
}

/* Reserves memory in advance, so that a layer is emitted with its birth time or the step does not begin. */
static bool reserve(World *world, double begin, double end)
{
    const WorldDef *def = &world->def;
    size_t layers = 0;
    bool capacity = true;
    long first;
    Emit poured;
    int fluid;
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].emit_count; i++) {
            layers += (size_t)emit_layers(&def->fluids[f].emits[i], def->spacing, begin, end, &first);
            capacity &= layer_reserve(world, &def->fluids[f].emits[i]);
        }
    if (world_pours(world, &poured, &fluid)) {
        layers += (size_t)emit_layers(&poured, def->spacing, begin, end, &first);
        capacity &= layer_reserve(world, &poured);
    }
    return capacity && births_reserve(&world->births, layers);
}

static int open_drains(const World *world, Fill open[DRAINS_MAX])
{
    int count = 0;
    for (int k = 0; k < world->def.drain_count; k++)
        if (!gate_is_closed(world->closed, gate_of_drain(k)))
            open[count++] = world->def.drains[k];
    return count;
}

static uint64_t gates_of(const WorldDef *def)
{
    uint64_t gates = 0;
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].emit_count; i++)
            gates |= 1ULL << gate_of_emitter(f, i);
    for (int k = 0; k < def->drain_count; k++)
        gates |= 1ULL << gate_of_drain(k);
    return gates;
}

void world_close_gates(World *world, uint64_t gates)
{
    world->closed = gates & gates_of(&world->def);
}

uint64_t world_closed_gates(const World *world)
{
    return world->closed;
}

bool world_names(const World *world, uint64_t born, Error *error)
{
    const uint64_t most = world->backend->gpu ? PARTICLE_IDS_GPU : PARTICLE_IDS;
    if (born < most)
        return true;
    error_set(error, "backend %s tells 2^%d particles apart, and %llu have come; %s", world->backend->name,
              world->backend->gpu ? 31 : 53, (unsigned long long)born,
              world->backend->gpu ? "go on with backend cpu" : "begin anew");
    return false;
}

bool world_flow(World *world, Error *error)
{
    const WorldDef *def = &world->def;
    const double begin = world_time_at(world, (double)world->step);
    const double end = world_time_at(world, (double)world->step + 1);
    if (world->emitted > 0 && !world_names(world, world->initial + world->emitted, error))
        return false;
    if (!reserve(world, begin, end))
        return error_set(error, "no memory for the particles that come");
    for (int f = 0; f < def->fluid_count; f++)
        for (int i = 0; i < def->fluids[f].emit_count; i++)
            if (!gate_is_closed(world->closed, gate_of_emitter(f, i)))
                let_in(world, f, &def->fluids[f].emits[i], &world->blocked[gate_of_emitter(f, i)], begin,
                       end);
    Emit poured;
    int fluid;
    if (world_pours(world, &poured, &fluid))
        let_in(world, fluid, &poured, NULL, begin, end);
    Fill open[DRAINS_MAX];
    const int count = open_drains(world, open);
    if (count > 0) {
        const size_t less = world->backend->drain(world->state, open, count);
        if (less == FLOW_LATER)
            flow_later(world, (Flow){.drains = true});
        else
            drained(world, less);
    }
    return true;
}

void world_thin_births(World *world)
{
    Births *births = &world->births;
    const bool all_here = !world->backend->held; /* a rank would drop births of foreign particles */
    ParticleId *id =
        all_here && births->count > births_few(world) ? malloc((world->count + 1) * sizeof *id) : NULL;
    if (id && world_read(world, &(ParticleArrays){.whole_id = id}))
        births_keep(births, id, world->count);
    free(id);
    world->births_most = 2 * births->count > births_few(world) ? 2 * births->count : births_few(world);
}

/* Plotted quantities of a running world: asked for first, answered when ready. Also forces on box and
   solids, requested once. */

static bool gather(World *world)
{
    double gravity[3];
    quat_rotate_inverse(world->box.orientation, world->def.gravity, gravity);
    return world->backend->gauge(world->state, gravity);
}

void world_gauge_request(World *world)
{
    if (world->gauge_asked)
        return;
    world->gauge_asked = gather(world);
    world->gauge_time = world_time_at(world, (double)world->step);
}

bool world_gauge(World *world, WorldGauge *gauge)
{
    *gauge = (WorldGauge){.time = world->gauge_time};
    if (!world->gauge_asked || !world->backend->gauged(world->state, gauge, false))
        return false;
    world->gauge_asked = false;
    gauge->total_known = true;
    for (int f = 0; f < world->def.fluid_count; f++)
        if (world->def.tension_model != TENSION_NONE && world->def.fluids[f].surface_tension > 0)
            gauge->total_known = false;
    return true;
}

bool world_sum_forces(World *world, Error *error)
{
    Forces *to = world->backend->forces_send ? &world->forces : &world->step_forces;
    if (!world->backend->enable_forces)
        return error_set(error, "backend %s sums no forces; use backend cpu or compute",
                         world->backend->name);
    if (world->bodies) /* floating bodies have summed forces since the start */
        bodies_copy_forces(world->bodies, to);
    world->sums_forces = world->bodies || world->backend->enable_forces(world->state, to, error);
    return world->sums_forces;
}

bool world_enable_forces(World *world, Error *error)
{
    world->forces = world->forces_before = (Forces){0};
    world->forces_wanted = world_sum_forces(world, error);
    return world->forces_wanted;
}

void world_forces(World *world, Forces *forces)
{
    const Backend *backend = world->backend;
    *forces = (Forces){0};
    /* For asynchronous steps: the next step takes these forces back. */
    if (backend->forces_send && !world_is_valid(world))
        return;
    if (world->bodies)
        bodies_end_owed(world->bodies, backend, world->state);
    if (backend->forces_send) {
        backend->forces_send(world->state);
        if (!backend->forces_take(world->state))
            return;
    }
    *forces = world->forces;
    forces_mean(forces);
    world->forces = world->forces_before = (Forces){0};
}
