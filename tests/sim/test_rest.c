/* Fluid comes to rest: friction of the resolution for fluids with less; density returning to the density
   of positions; none below 0. */
#include "sim/methods/dfsph/dfsph.h"
#include "sim/methods/mueller/mueller.h"
#include "sim/methods/wcsph/wcsph_private.h"
#include "sim/step/constants.h"
#include "tests/sim/fixture.h"

/* A dam of 13 x 15 particles in the plane. */
static WorldDef dam(const char *method, double alpha)
{
    WorldDef def = fixture_def(1, 1, 0.04);
    def.dimensions = 2;
    def.spacing = 0.04;
    def.support = 3;
    snprintf(def.method, sizeof def.method, "%s", method);
    mueller_def(&def)->numerical_viscosity = dfsph_def(&def)->rest_viscosity = alpha;
    def.dt = 0.001;
    def.substeps = 1;
    fixture_block(&def, 0, -0.5, 0, 0, 0, 0.6, 0);
    return def;
}

static uint64_t hash_after(const WorldDef *def, int steps)
{
    World *world = fixture_world(def);
    fixture_step(world, steps);
    const uint64_t hash = world_hash(world);
    world_destroy(world);
    return hash;
}

static double rms_speed(World *world)
{
    WorldSums sums;
    world_sums(world, &sums);
    return sqrt(2 * sums.kinetic_energy / sums.mass);
}

/* alpha is a least viscosity: no more, and no less. */
static void check_alpha(const char *method, double speed)
{
    WorldDef def = dam(method, 0.03), own = dam(method, 0);
    def.reproducible = own.reproducible = true;
    const double least = 0.03 * speed * def.support * def.spacing / 16 * def.fluids[0].density;
    own.fluids[0].viscosity = least;
    const uint64_t expected = hash_after(&own, 60);
    assert_true(hash_after(&def, 60) == expected);
    def.fluids[0].viscosity = 0.001;
    assert_true(hash_after(&def, 60) == expected);
    def.fluids[0].viscosity = own.fluids[0].viscosity = 2 * least;
    assert_true(hash_after(&def, 60) == hash_after(&own, 60));
    def.fluids[0].viscosity = 0;
    mueller_def(&def)->numerical_viscosity = dfsph_def(&def)->rest_viscosity = 0;
    assert_true(hash_after(&def, 60) != expected);
}

static void a_fluid_that_names_less_has_that_of_alpha(void **state)
{
    (void)state;
    const WorldDef def = dam("mueller", 0);
    check_alpha("mueller", def.sound_speed);
    if (!fixture_on_fragment())
        check_alpha("dfsph", sqrt(sqrt(9.81 * 9.81) * def.support * def.spacing));
}

/* Walls hold by a fluid's named viscosity: without viscosity, fluid glides. */
static void walls_hold_no_fluid_that_names_none(void **state)
{
    (void)state;
    fixture_needs_cpu("fragment has no walls without slip");
    WorldDef free = dam("mueller", 0.03), held = free;
    held.wall_slip = SLIP_NONE;
    assert_true(hash_after(&free, 20) == hash_after(&held, 20));
    free.fluids[0].viscosity = held.fluids[0].viscosity = 0.001;
    assert_true(hash_after(&free, 20) != hash_after(&held, 20));
}

static void a_fall_comes_to_rest(void **state)
{
    (void)state;
    fixture_needs_cpu("some thousand steps");
    for (int calm = 0; calm < 2; calm++) {
        const WorldDef def = dam("mueller", calm ? 0.03 : 0);
        World *world = fixture_world(&def);
        fixture_step(world, 10000);
        printf("mueller, alpha %g, after 10 s: %.4f m/s (rms)\n", mueller_def(&def)->numerical_viscosity,
               rms_speed(world));
        assert_true(calm ? rms_speed(world) < 0.06 : rms_speed(world) > 0.5);
        world_destroy(world);
    }
}

/* A column of 13 x 15 particles from wall to wall: its rms speed over sqrt(g H) after so many steps of dt s.
 */
static double column_speed(WorldDef *def, double dt, int steps)
{
    def->box_size[0] = 13 * def->spacing;
    def->dt = dt;
    World *world = fixture_world(def);
    fixture_step(world, steps);
    const double speed = rms_speed(world) / sqrt(9.81 * 15 * def->spacing);
    printf("%s, after %g s: %.4f sqrt(g H)\n", def->method, dt * steps, speed);
    world_destroy(world);
    return speed;
}

/* Steps of pbf do not take turns with more and with fewer iterations. */
static void a_column_of_pbf_rests(void **state)
{
    (void)state;
    fixture_needs_cpu("long");
    WorldDef def = dam("pbf", 0);
    assert_true(column_speed(&def, 1 / 60.0, 1800) < 0.015);
}

/* Water's viscosity leaves wcsph nearly all artificial viscosity; the equivalent viscosity leaves none. */
static void artificial_viscosity_fills_up(void **state)
{
    (void)state;
    WorldDef def = dam("wcsph", 0);
    const double stands_for = numerical_kinematic(&def, 0.05) * def.fluids[0].density;
    assert_float_equal(step_alpha(&def, 0.05, 0), 0.05, 1e-12);
    def.fluids[0].viscosity = 0.001;
    assert_true(step_alpha(&def, 0.05, 0) > 0.0499 && step_alpha(&def, 0.05, 0) < 0.05);
    def.fluids[0].viscosity = 0.5 * stands_for;
    assert_float_equal(step_alpha(&def, 0.05, 0), 0.025, 1e-12);
    def.fluids[0].viscosity = 1.01 * stands_for;
    assert_float_equal(step_alpha(&def, 0.05, 0), 0, 0);
}

/* A full box whose particles carry 1 % more than their places say: mean density, over rho0, after so many
 * seconds. */
static double density_left(double delta, double seconds)
{
    enum { SIDE = 12, COUNT = SIDE * SIDE };
    static float x[3 * COUNT], density[COUNT];
    WorldDef def = dam("wcsph", 0);
    def.box_size[0] = def.box_size[1] = SIDE * def.spacing;
    def.fluids[0].fill_count = 0;
    memset(def.gravity, 0, sizeof def.gravity);
    snprintf(wcsph_def(&def)->kernel, sizeof wcsph_def(&def)->kernel, "quintic");
    wcsph_def(&def)->delta_sph = delta;
    for (int i = 0; i < COUNT; i++) {
        x[3 * i] = (float)((i % SIDE + 0.5 - SIDE / 2) * def.spacing);
        x[3 * i + 1] = (float)((i / SIDE + 0.5) * def.spacing);
        density[i] = 1010;
    }
    def.initial = &(InitialState){.count = COUNT, .position = x, .density = density};
    World *world = fixture_world(&def);
    fixture_step(world, (int)(seconds / def.dt));
    State s = fixture_read(world);
    double sum = 0;
    for (size_t i = 0; i < s.count; i++)
        sum += (double)s.density[i] / 1000 / COUNT;
    fixture_free(&s);
    world_destroy(world);
    return sum;
}

static void density_comes_back_to_the_places(void **state)
{
    (void)state;
    fixture_needs("wcsph");
    /* 400 h / c = 2.4 s: 1 % is 0.43 % then */
    const double after = density_left(0.1, 2.05) - 1, without = density_left(0, 0.2) - 1;
    printf("carried too much: %.4f with diffusion, %.4f without\n", after, without);
    assert_float_equal(after, 0.01 * exp(-2.05 * 20 / (400 * 0.12)), 2e-4);
    assert_float_equal(without, 0.01, 2e-5);
}

static void density_stays_above_zero_and_comes_back(void **state)
{
    (void)state;
    static const float starts[] = {0.02F, 0, -0.1F, -0.5F, -0.51F, -0.8F, -0.999F};
    for (size_t k = 0; k < sizeof starts / sizeof *starts; k++) {
        assert_true(wcsph_density_after(starts[k], 0) == starts[k]); /* loaded equals saved */
        float e = starts[k];
        for (int i = 0; i < 400; i++) {
            const float before = e;
            e = wcsph_density_after(e, -0.01F);
            assert_true(e > -1 && e < before);
        }
        for (int i = 0; i < 400; i++)
            e = wcsph_density_after(e, 0.01F);
        assert_float_equal(e, starts[k], 0.02 * (1 + (double)starts[k]));
    }
}

static double rms_over_fall(World *world, double height, int steps)
{
    double sum = 0;
    for (int k = 0; k < steps; k += 20) {
        WorldSums sums;
        fixture_step(world, 20);
        world_sums(world, &sums);
        sum += 20 * 2 * sums.kinetic_energy / sums.mass / steps;
    }
    return sqrt(sum / (9.81 * height));
}

static WorldDef still_wcsph(void)
{
    WorldDef def = fixture_def(1, 1.2, 0.5);
    snprintf(def.method, sizeof def.method, "wcsph");
    def.dimensions = 2;
    def.spacing = 0.05;
    def.support = 3;
    snprintf(wcsph_def(&def)->kernel, NAME_SIZE, "quintic");
    def.fluids[0].start = START_HYDROSTATIC;
    wcsph_def(&def)->viscosity_form = VISCOSITY_RADIAL;
    wcsph_def(&def)->artificial_viscosity = 0.02;
    wcsph_def(&def)->delta_sph = 0.1;
    def.sound_speed = 20;
    def.dt = 0.001;
    return def;
}

/* Densities store the work of solids: for fast flow a boundary particle counts twice in wcsph's rate, as in
   the force. Counted once, sound grows to a standing wave in the column above a plate, most of all with
   shifting: 0.04 after 10 s. */
static void a_column_above_a_plate_comes_to_rest(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    WorldDef def = still_wcsph();
    wcsph_def(&def)->shifting = 0.2;
    fixture_block(&def, 0, -0.5, 0.2, -0.25, 0.5, 0.8, 0.25);
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_BOX, .centre = {0, 0.1, 0}, .size = {1, 0.2, 1}, .axis = {0, 1, 0}};
    World *world = fixture_world(&def);
    fixture_step(world, 10000);
    const double speed = rms_over_fall(world, 0.6, 2000);
    printf("wcsph, a column above a plate, 10 to 12 s: %.4f sqrt(g H)\n", speed);
    assert_true(speed < 0.004);
    world_destroy(world);
}

/* Diffusion next to a solid leaves the density of fluid at rest. Levelled, it would drive eddies around a
   disc, at 0.004 for ever. */
static void diffusion_drives_no_eddies(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    WorldDef def = still_wcsph();
    fixture_block(&def, 0, -0.5, 0, -0.25, 0.5, 0.8, 0.25);
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.4, 0}, .radius = 0.2, .axis = {0, 1, 0}};
    World *world = fixture_world(&def);
    fixture_step(world, 10000);
    const double speed = rms_over_fall(world, 0.8, 2000);
    printf("wcsph, water around a disc, 10 to 12 s: %.4f sqrt(g H)\n", speed);
    assert_true(speed < 0.0025);
    world_destroy(world);
}

/* Pressure of mueller sees the boundary part of the number density: without it the column above a plate hums,
   at 0.02 for ever. */
static void a_column_of_mueller_above_a_plate_comes_to_rest(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    WorldDef def = fixture_def(1, 1.2, 0.5);
    snprintf(def.method, sizeof def.method, "mueller");
    def.dimensions = 2;
    def.spacing = 0.05;
    def.support = 3;
    mueller_def(&def)->numerical_viscosity = 0.03;
    def.sound_speed = 20;
    def.dt = 0.002;
    fixture_block(&def, 0, -0.5, 0.2, -0.25, 0.5, 0.8, 0.25);
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_BOX, .centre = {0, 0.1, 0}, .size = {1, 0.2, 1}, .axis = {0, 1, 0}};
    World *world = fixture_world(&def);
    fixture_step(world, 7500);
    const double speed = rms_over_fall(world, 0.6, 1000);
    printf("mueller, a column above a plate, 15 to 17 s: %.4f sqrt(g H)\n", speed);
    assert_true(speed < 0.003);
    world_destroy(world);
}

static double around_a_disc(const char *method, double dt)
{
    WorldDef def = fixture_def(1, 1.2, 0.5);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.dimensions = 2;
    def.spacing = 0.05;
    def.support = 3.1;
    dfsph_def(&def)->surface_lack = 1;
    dfsph_def(&def)->rest_viscosity = 0.15;
    def.dt = dt;
    fixture_block(&def, 0, -0.5, 0, -0.25, 0.5, 0.8, 0.25);
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.4, 0}, .radius = 0.2, .axis = {0, 1, 0}};
    World *world = fixture_world(&def);
    fixture_step(world, (int)(10 / dt));
    const double speed = rms_over_fall(world, 0.8, 1000);
    world_destroy(world);
    return speed;
}

/* The solvers of dfsph and pbf hold n plus the boundary part. Were places moved back to n after each step,
   water around a disc would stir itself, at 0.02 and 0.008 for ever. */
static void water_around_a_disc_comes_to_rest(void **state)
{
    (void)state;
    fixture_needs_cpu("many steps");
    const double dfsph = around_a_disc("dfsph", 0.005), pbf = around_a_disc("pbf", 0.01);
    printf("water around a disc, 10 s on: dfsph %.4f, pbf %.4f sqrt(g H)\n", dfsph, pbf);
    assert_true(dfsph < 0.003 && pbf < 0.003);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fluid_that_names_less_has_that_of_alpha),
        cmocka_unit_test(walls_hold_no_fluid_that_names_none),
        cmocka_unit_test(a_fall_comes_to_rest),
        cmocka_unit_test(a_column_of_pbf_rests),
        cmocka_unit_test(artificial_viscosity_fills_up),
        cmocka_unit_test(a_column_above_a_plate_comes_to_rest),
        cmocka_unit_test(a_column_of_mueller_above_a_plate_comes_to_rest),
        cmocka_unit_test(diffusion_drives_no_eddies),
        cmocka_unit_test(water_around_a_disc_comes_to_rest),
        cmocka_unit_test(density_comes_back_to_the_places),
        cmocka_unit_test(density_stays_above_zero_and_comes_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
