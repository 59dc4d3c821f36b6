/* Gauges of a running world, against sums in double over particles read back. */
#include "fixture.h"

#include "sim/def.h"
#include "sim/step/backend.h"

#include <time.h>

enum { MOST = 20000 };

typedef struct Read {
    float position[4 * MOST], velocity[4 * MOST], compression[MOST];
    uint32_t fluid[MOST];
} Read;

static Read all;

/* On a GPU with delay. */
static bool answered(World *world, WorldGauge *gauge)
{
    for (int tries = 0; tries < 5000; tries++) {
        if (world_gauge(world, gauge))
            return true;
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    }
    return false;
}

static size_t read_all(World *world)
{
    WorldInfo info;
    ParticleArrays out = {.position = all.position, .velocity = all.velocity, .fluid = all.fluid};
    out.scalar[SCALAR_COMPRESSION] = all.compression;
    world_info(world, &info);
    assert_true(info.count > 100 && info.count <= MOST);
    assert_true(world_read(world, &out));
    return info.count;
}

/* The same from the particles, the energy of compression by Simpson's rule over p / rho^2. */
static double stored(const WorldDef *def, double x)
{
    enum { STEPS = 200 };
    const double c2 = def->sound_speed * def->sound_speed, dx = x / STEPS;
    double sum = 0;
    if (x < 0 && !def->negative_pressure)
        return 0;
    for (int i = 0; i <= STEPS; i++) {
        const double r = 1 + i * dx,
                     p = strcmp(def->method, "wcsph") == 0 ? c2 / 7 * (pow(r, 7) - 1) : c2 * (r - 1);
        sum += p / (r * r) * (i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2);
    }
    return sum * dx / 3;
}

static WorldGauge brute_force(const WorldDef *def, World *world)
{
    const size_t count = read_all(world);
    WorldGauge sum = {0};
    WorldInfo info;
    world_info(world, &info);
    for (size_t i = 0; i < count; i++) {
        const float *x = all.position + 4 * i, *v = all.velocity + 4 * i;
        const double m = def->fluids[all.fluid[i]].density * pow(def->spacing, def->dimensions),
                     e = (double)all.compression[i], pressed = fmax(e, 0);
        sum.density_error_mean += pressed / (double)count;
        sum.density_error_max = fmax(sum.density_error_max, pressed);
        sum.compression_energy += m * stored(def, e);
        for (int k = 0; k < 3; k++) {
            sum.kinetic_energy += 0.5 * m * (double)v[k] * (double)v[k];
            sum.potential_energy -= m * info.gravity[k] * (double)x[k];
        }
    }
    return sum;
}

static void assert_near(const char *what, double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance * fabs(expected)))
        fail_msg("%s: %.9g, expected %.9g", what, value, expected);
}

/* Two fluids, pressed, in a box that is turned, so that gravity is along all axes. */
static WorldDef pressed(const char *method)
{
    WorldDef def = fixture_def(1, 1, 1);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.spacing = fixture_coarse(0.05, 0.08);
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 0.3, 0.5);
    fixture_block(&def, 1, -0.5, 0.3, -0.5, 0.5, 0.6, 0.5);
    def.fluid_count = 2;
    def.fluids[1].density = 800;
    return def;
}

static void compare(const WorldDef *def)
{
    WorldGauge gauge;
    WorldInfo info;
    World *world = fixture_world(def);
    const BoxTarget turned = {.orientation = {0.2, 0.1, 0.3, 0.9}};
    world_carry_box(world, &turned);
    fixture_step(world, fixture_count(30, 10));
    assert_false(world_gauge(world, &gauge)); /* not requested */
    const WorldGauge expected = brute_force(def, world);
    world_gauge_request(world);
    world_info(world, &info);
    assert_true(answered(world, &gauge));
    assert_false(world_gauge(world, &gauge)); /* once */
    world_gauge_request(world);
    assert_true(answered(world, &gauge));
    assert_true(gauge.time == info.time && gauge.total_known);
    assert_true(expected.density_error_max > 1e-4 && expected.kinetic_energy > 0);
    assert_near("mean error of density", gauge.density_error_mean, expected.density_error_mean, 1e-5);
    assert_near("greatest", gauge.density_error_max, expected.density_error_max, 1e-5);
    assert_near("kinetic energy", gauge.kinetic_energy, expected.kinetic_energy, 1e-5);
    assert_near("potential energy", gauge.potential_energy, expected.potential_energy, 1e-5);
    assert_near("energy of compression", gauge.compression_energy, expected.compression_energy, 1e-4);
    world_destroy(world);
}

static void sums_are_those_of_the_particles(void **state)
{
    (void)state;
    WorldDef def = pressed("mueller");
    compare(&def);
    def.negative_pressure = true;
    compare(&def);
}

static void so_with_densities_that_are_carried(void **state)
{
    (void)state;
    fixture_needs("method wcsph");
    const WorldDef def = pressed("wcsph");
    compare(&def);
}

/* A step does not know whether somebody looks. */
static void looking_changes_no_bit(void **state)
{
    (void)state;
    WorldGauge gauge;
    WorldDef def = pressed("mueller");
    def.reproducible = true;
    World *seen = fixture_world(&def), *unseen = fixture_world(&def);
    for (int frame = 0; frame < fixture_count(20, 6); frame++) {
        world_gauge_request(seen);
        fixture_step(seen, 1);
        world_gauge(seen, &gauge);
        fixture_step(unseen, 1);
    }
    assert_int_equal(world_hash(seen), world_hash(unseen));
    world_destroy(seen);
    world_destroy(unseen);
}

/* Of a fall the sum stays, to what the step's density lags behind. */
static void a_fall_keeps_its_energy(void **state)
{
    (void)state;
    WorldGauge before, after;
    WorldDef def = fixture_def(1, 2, 1);
    def.spacing = 0.1;
    fixture_block(&def, 0, -0.2, 1.4, -0.2, 0.2, 1.8, 0.2);
    World *world = fixture_world(&def);
    world_gauge_request(world);
    assert_true(answered(world, &before));
    fixture_step(world, 100);
    world_gauge_request(world);
    assert_true(answered(world, &after));
    assert_true(after.kinetic_energy > 0.05 * before.potential_energy);
    const double was = before.kinetic_energy + before.potential_energy + before.compression_energy,
                 is = after.kinetic_energy + after.potential_energy + after.compression_energy;
    assert_near("energy", is, was, 1e-4);
    world_destroy(world);
}

static void tension_hides_the_total(void **state)
{
    (void)state;
    fixture_needs("surface tension");
    WorldGauge gauge;
    WorldDef def = pressed("mueller");
    def.tension_model = TENSION_COHESION;
    def.fluids[1].surface_tension = 1;
    World *world = fixture_world(&def);
    world_gauge_request(world);
    assert_true(answered(world, &gauge));
    assert_false(gauge.total_known);
    world_destroy(world);
}

static void courant_number_is_of_the_last_step(void **state)
{
    (void)state;
    WorldInfo info;
    WorldSums sums;
    WorldDef def = pressed("mueller");
    World *world = fixture_world(&def);
    world_info(world, &info);
    assert_true(info.courant == 0);
    fixture_step(world, 5);
    world_is_valid(world); /* reads a GPU's findings */
    world_info(world, &info);
    world_sums(world, &sums);
    const double c = def.sound_speed, h = def.support * def.spacing;
    assert_true(info.courant > def.dt / def.substeps * c / h);
    assert_near("Courant number", info.courant, def.dt / def.substeps * (c + sums.max_speed) / h, 0.01);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_are_those_of_the_particles),
        cmocka_unit_test(so_with_densities_that_are_carried),
        cmocka_unit_test(looking_changes_no_bit),
        cmocka_unit_test(a_fall_keeps_its_energy),
        cmocka_unit_test(tension_hides_the_total),
        cmocka_unit_test(courant_number_is_of_the_last_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
