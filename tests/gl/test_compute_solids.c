/* Solids on the backend `compute` against `cpu`, from the same states. */
#include "tests/gl/compare.h"
#include "tests/lists.h"

#include "sim/gpu/compute/compute.h"
#include "sim/methods/wcsph/wcsph.h"

/* Two viscous fluids around a solid of each kind, some moving, in a moving box. */
static WorldDef solids_def(int dimensions)
{
    WorldDef def = fixture_def(1.2, 1, 0.9);
    def.dimensions = dimensions;
    def.spacing = dimensions == 2 ? 0.025 : 0.06;
    def.sound_speed = 15;
    def.dt = 0.001;
    *world_threads(&def) = 1;
    def.fluid_count = 2;
    def.fluids[0].viscosity = 1;
    def.fluids[1] = (FluidDef){.name = "oil", .density = 700, .viscosity = 3};
    fixture_block(&def, 0, -0.6, 0, -0.45, 0.3, 0.4, 0.45);
    fixture_block(&def, 1, -0.6, 0.4, -0.45, 0.3, 0.6, 0.45);
    add_motion(&def, (Motion){.kind = MOTION_SHAKE, .axis = {1, 0.3, 0}, .amplitude = 0.05, .frequency = 2});
    static const Motion rock = {.kind = MOTION_ROCK, .axis = {0, 0, 1}, .angle_deg = 25, .frequency = 2},
                        shake = {.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.05, .frequency = 3};
    const SolidDef solids[] = {
        {.kind = SOLID_SPHERE, .centre = {-0.35, 0.3, 0}, .radius = 0.12, .slip = SLIP_NONE},
        {.kind = SOLID_BOX,
         .centre = {0.2, 0.25, 0},
         .size = {0.08, 0.4, 0.5},
         .axis = {0, 0, 1},
         .angle_deg = 10,
         .slip = SLIP_NONE,
         .motion_count = 1,
         .motions = &rock},
        {.kind = SOLID_BOWL,
         .centre = {-0.05, 0.3, dimensions == 2 ? 0 : 0.1},
         .radius = 0.1,
         .thickness = 0.05,
         .axis = {0.2, 1, 0},
         .motion_count = 1,
         .motions = &shake},
        {.kind = SOLID_CYLINDER,
         .centre = {-0.3, 0.05, 0},
         .radius = 0.1,
         .height = 0.5,
         .axis = {0.3, 0, 1}},
    };
    def.solid_count = dimensions == 2 ? 3 : 4;
    memcpy(def.solids, solids, sizeof solids);
    return def;
}

/* wcsph with all terms: a fluid with laminar viscosity, a fluid with artificial viscosity, density
   diffusion. */
static WorldDef full_wcsph_def(void)
{
    WorldDef def = solids_def(2);
    snprintf(def.method, sizeof def.method, "wcsph");
    wcsph_def(&def)->delta_sph = 0.1;
    wcsph_def(&def)->artificial_viscosity = 0.2;
    def.fluids[1].viscosity = 0;
    def.dt = 0.0005;
    return def;
}

static void one_step_is_that_of_the_cpu(void **state)
{
    (void)state;
    static const char *const names[] = {"2D, mueller", "3D, mueller", "2D, wcsph"};
    for (int run = 0; run < 3; run++) {
        const WorldDef def = run < 2 ? solids_def(2 + run) : full_wcsph_def();
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        substeps(cpu, 150);
        copy_state(cpu, gpu);
        compare_one_step(names[run], cpu, gpu);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

/* What a user runs, coarser: after a step, and 200 steps on. */
static void scenes_stay_with_the_cpu(void **state)
{
    (void)state;
    static const char *const names[] = {"pillar", "paddle"};
    for (int n = 0; n < 2; n++) {
        const WorldDef def = scene_def(names[n], 0.05);
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        substeps(cpu, 300);
        copy_state(cpu, gpu);
        compare_one_step(names[n], cpu, gpu);
        compare_run(&def, names[n], cpu, gpu, 100);
        assert_true(least_clearance(gpu, &def) > -1e-5);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

/* Without reproducible mode the guard has 32 bits: a particle within rounding of a surface may be held by
   a single backend only. The error is the guard's shift and the speed of arrival. */
static void single_precision_is_near(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        WorldDef def = solids_def(dimensions);
        def.reproducible = false;
        World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
        substeps(cpu, 150);
        double off = 0;
        size_t others = 0, all = 0;
        for (int i = 0; i < 20; i++) {
            copy_state(cpu, gpu);
            substeps(cpu, 1);
            substeps(gpu, 1);
            Snapshot a = snapshot_read(cpu), b = snapshot_read(gpu);
            for (size_t k = 0; k < a.count; k++) {
                const size_t x = 4 * a.who[k].at, y = 4 * b.who[k].at;
                off = fmax(off, apart(a.position + x, b.position + y));
                others += apart(a.velocity + x, b.velocity + y) > 1e-3;
            }
            all += a.count;
            snapshot_free(&a);
            snapshot_free(&b);
        }
        printf(
            "%dD, single precision: positions off by %.1e m, velocities by more than 1 mm/s of %zu in %zu; guarded %zu, on "
            "the CPU %zu\n",
            dimensions, off, others, all, info_of(gpu).guarded, info_of(cpu).guarded);
        assert_true(off < 1e-5 && others * 1000 < all);
        world_destroy(cpu);
        world_destroy(gpu);
    }
}

/* A cup moving to and fro by a radius per frame, at 200 g, spills fluid over the rim, not through the
   wall; a box with a ball and a pillar is shaken at ten times a hand's limit. */
static WorldDef cup_def(int dimensions)
{
    WorldDef def = fixture_def(1.2, 1, 0.6);
    def.dimensions = dimensions;
    def.spacing = dimensions == 2 ? 0.02 : 0.03;
    def.sound_speed = 60;
    def.dt = 0.0002;
    def.gravity[1] = -150;
    def.fluids[0].viscosity = 10;
    def.solids[def.solid_count++] = (SolidDef){
        .kind = SOLID_BOWL, .centre = {0, 0.6, 0}, .radius = 0.2, .thickness = 0.042, .axis = {0, 1, 0}};
    add_solid_motion(
        &def.solids[0],
        (Motion){.kind = MOTION_SHAKE, .axis = {1, 0, 0}, .amplitude = 0.2, .frequency = 1 / 0.064});
    add_fill(&def.fluids[0], (Fill){.kind = FILL_BALL, .centre = {0, 0.505, 0}, .radius = 0.09});
    return def;
}

static void a_shaken_cup_does_not_leak(void **state)
{
    (void)state;
    for (int run = 0; run < 4; run++) {
        WorldDef def = cup_def(2 + run % 2);
        def.reproducible = run < 2; /* in double precision */
        World *world = world_on(def, "compute");
        for (int i = 0; i < 60; i++) {
            substeps(world, 5);
            assert_true(least_clearance(world, &def) > -1e-5);
        }
        assert_true(info_of(world).count > 50);
        world_destroy(world);
    }
}

static WorldDef shaken_def(void)
{
    WorldDef def = fixture_def(1.2, 0.8, 0.8);
    def.spacing = 0.08;
    def.sound_speed = 60;
    def.dt = 0.0005;
    def.fluids[0].viscosity = 1;
    def.limits.speed *= 10;
    def.limits.acceleration *= 10;
    def.limits.turn_speed_deg *= 10;
    def.limits.turn_acceleration_deg *= 10;
    fixture_block(&def, 0, -0.6, 0, -0.4, 0.6, 0.5, 0.4);
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_BOX, .centre = {0.2, 0.4, 0}, .size = {0.12, 0.8, 0.12}, .axis = {0, 1, 0}};
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {-0.3, 0.25, 0}, .radius = 0.12};
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_CYLINDER,
                   .centre = {-0.2, 0.16, 0.2}, /* off the floor: nothing is pinched */
                   .radius = 0.08,
                   .height = 0.3,
                   .axis = {1, 0.2, 0}};
    return def;
}

static void shake(bool exact)
{
    WorldDef def = shaken_def();
    def.reproducible = exact;
    World *world = world_on(def, "compute");
    const size_t guarded = info_of(world).guarded;
    uint32_t seed = 2;
    WorldSums sums;
    for (int i = 0; i < 150; i++) {
        if (i % 25 == 0) {
            BoxTarget target = {.orientation = {0, 0, 0, 1}};
            double turn[3];
            for (int k = 0; k < 3; k++) {
                target.position[k] = 6 * (fixture_random(&seed) - 0.5);
                turn[k] = 3 * (fixture_random(&seed) - 0.5);
            }
            quat_turn(turn, target.orientation);
            world_set_target(world, &target);
        }
        substeps(world, 1);
        if (i % 5 == 0)
            assert_true(least_clearance(world, &def) > -1e-5);
    }
    world_sums(world, &sums);
    assert_true(sums.max_speed > 2 && info_of(world).guarded > guarded);
    world_destroy(world);
}

static void a_shaken_box_loses_no_particle(void **state)
{
    (void)state;
    shake(true);
    shake(false);
}

/* Viscosity that a hand turns on while the world lives makes solids at rest hold fluid. */
static void friction_comes_with_viscosity(void **state)
{
    (void)state;
    WorldDef def = shaken_def(), thick;
    def.fluids[0].viscosity = 0;
    def.dt = 0.001;
    def.sound_speed = 20;
    for (int k = 0; k < def.solid_count; k++)
        def.solids[k].slip = SLIP_NONE;
    World *cpu = world_on(def, "cpu"), *gpu = world_on(def, "compute");
    Error error;
    thick = def;
    thick.fluids[0].viscosity = 20;
    substeps(cpu, 50);
    copy_state(cpu, gpu);
    assert_true(world_change(cpu, &thick, &error) && world_change(gpu, &thick, &error));
    compare_one_step("viscosity turned on", cpu, gpu);
    world_destroy(cpu);
    world_destroy(gpu);
}

/* Also into a world that is elsewhere: solids follow from the time. */
static void save_load_step_is_step(void **state)
{
    (void)state;
    const WorldDef def = solids_def(2);
    World *world = world_on(def, "compute"), *other = world_on(def, "compute");
    substeps(world, 40);
    substeps(other, 7);
    copy_state(world, other);
    assert_true(world_hash(world) == world_hash(other));
    substeps(world, 30);
    substeps(other, 30);
    assert_true(world_hash(world) == world_hash(other));
    world_destroy(world);
    world_destroy(other);
}

/* A scene without solids, emitters and drains has no pass and no buffer of theirs. */
static void what_is_not_named_is_not_there(void **state)
{
    (void)state;
    WorldDef def = shaken_def();
    def.solid_count = 0;
    World *world = world_on(def, "compute");
    const Compute *compute = world->state;
    for (int pass = COMPUTE_BOUNDARY_BIN; pass <= COMPUTE_DRAIN_GATHER; pass++)
        assert_int_equal(compute->program[pass], 0);
    assert_true(!compute->boundary.rest && !compute->boundary.block && !compute->flow.block);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(one_step_is_that_of_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(scenes_stay_with_the_cpu, no_gl_errors),
        cmocka_unit_test_teardown(single_precision_is_near, no_gl_errors),
        cmocka_unit_test_teardown(a_shaken_cup_does_not_leak, no_gl_errors),
        cmocka_unit_test_teardown(a_shaken_box_loses_no_particle, no_gl_errors),
        cmocka_unit_test_teardown(friction_comes_with_viscosity, no_gl_errors),
        cmocka_unit_test_teardown(what_is_not_named_is_not_there, no_gl_errors),
        cmocka_unit_test_teardown(save_load_step_is_step, no_gl_errors),
    };
    return cmocka_run_group_tests_name("gl.compute_solids", tests, compare_setup, context_teardown);
}
