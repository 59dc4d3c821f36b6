/* Fluids for tests of methods with constant number density, and common checks. */
#ifndef SLOSH_TEST_CLOUD_H
#define SLOSH_TEST_CLOUD_H

#include "tests/sim/fixture.h"

#include "sim/state.h"

enum { SIDE = 5, N = SIDE * SIDE * SIDE };

typedef struct Cloud {
    float x[3 * N], v[3 * N];
    uint8_t fluid[N];
} Cloud;

/* A cube out of order (by `disorder`, m) in the middle of the def's box, shrinking (by `rate`, 1/s), half of
   it a thousandth as dense. No gravity. */
static inline void cloud_make(Cloud *cloud, WorldDef *def, double disorder, double rate)
{
    uint32_t seed = 3;
    memset(def->gravity, 0, sizeof def->gravity);
    def->fluid_count = 2;
    def->fluids[1] = (FluidDef){.name = "air", .density = 1};
    for (int i = 0; i < N; i++) {
        const int index[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        for (int k = 0; k < 3; k++) {
            const double x = 0.1 * (index[k] - 0.5 * (SIDE - 1)) + disorder * (fixture_random(&seed) - 0.5);
            cloud->x[3 * i + k] = (float)(x + (k == 1 ? 0.5 * def->box_size[1] : 0));
            cloud->v[3 * i + k] = (float)(-rate * x);
        }
        cloud->fluid[i] = index[0] > 2;
    }
}

static inline World *cloud_world(WorldDef *def, const Cloud *cloud)
{
    def->initial =
        &(InitialState){.count = N, .position = cloud->x, .velocity = cloud->v, .fluid = cloud->fluid};
    World *world = fixture_world(def);
    def->initial = NULL;
    return world;
}

static inline WorldDef dam_of(const char *method, double dt, int threads)
{
    WorldDef def = fixture_def(1.6, 1, 0.4);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.dt = dt;
    def.spacing = 0.05;
    fixture_block(&def, 0, -0.8, 0, -0.2, -0.3, 0.6, 0.2);
    *world_threads(&def) = threads;
    return def;
}

static inline void check_same_bits_on_threads(WorldDef def, int steps)
{
    static const int threads[] = {1, 2, 3, 8};
    uint64_t hash[4];
    for (int k = 0; k < 4; k++) {
        *world_threads(&def) = threads[k];
        World *world = fixture_world(&def);
        fixture_step(world, steps);
        hash[k] = world_hash(world);
        world_destroy(world);
    }
    assert_true(hash[0] == hash[1] && hash[0] == hash[2] && hash[0] == hash[3]);
}

/* After a saved state a world repeats the same steps. */
static inline void check_goes_on(const WorldDef *def, int steps)
{
    World *world = fixture_world(def);
    WorldState saved = {0};
    Error error = {0};
    fixture_step(world, steps);
    assert_true(world_save(world, &saved, &error));
    fixture_step(world, 5);
    const uint64_t first = world_hash(world);
    assert_true(world_load(world, &saved, &error));
    fixture_step(world, 5);
    assert_true(world_hash(world) == first);
    world_state_free(&saved);
    world_destroy(world);
}

#endif
