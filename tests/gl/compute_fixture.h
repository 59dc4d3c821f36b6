/* What the tests of backend `compute` share: worlds on both backends, from the same states. */
#ifndef SLOSH_COMPUTE_FIXTURE_H
#define SLOSH_COMPUTE_FIXTURE_H

#include "tests/render/fixture.h"
#include "tests/sim/fixture.h"

#include "sim/gl/backends.h"
#include "sim/gl/compute/compute.h"
#include "sim/world_struct.h"

static inline int compute_setup(void **state)
{
    if (context_setup(state) != 0)
        return 1;
    backends_add();
    return 0;
}

/* Two viscous fluids over each other, stirred, in a box that moves in all ways. */
static inline WorldDef stirred_def(int dimensions)
{
    WorldDef def = fixture_def(1.2, 1, 0.9);
    def.dimensions = dimensions;
    def.spacing = dimensions == 2 ? 0.02 : 0.06;
    def.sound_speed = 15;
    def.dt = 0.0005;
    def.threads = 1;
    def.fluid_count = 2;
    def.fluids[0].viscosity = 1;
    def.fluids[1] = (FluidDef){.name = "oil", .density = 700, .viscosity = 3};
    fixture_block(&def, 0, -0.6, 0, -0.45, 0.1, 0.4, 0.45);
    fixture_block(&def, 1, -0.6, 0.4, -0.45, 0.3, 0.6, 0.45);
    def.motions[def.motion_count++] =
        (Motion){.kind = MOTION_SHAKE, .axis = {1, 0.3, 0}, .amplitude = 0.05, .frequency = 2};
    def.motions[def.motion_count++] =
        (Motion){.kind = MOTION_ROCK, .axis = {0, 0, 1}, .angle_deg = 20, .frequency = 1.5};
    return def;
}

static inline World *world_on(WorldDef def, const char *backend)
{
    snprintf(def.backend, sizeof def.backend, "%s", backend);
    return fixture_world(&def);
}

/* The same state on both. */
static inline void copy_state(World *from, World *to)
{
    WorldState saved = {0};
    Error error;
    if (!world_save(from, &saved, &error) || !world_load(to, &saved, &error))
        fail_msg("%s", error.message);
    world_state_free(&saved);
}

#endif
