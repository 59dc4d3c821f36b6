/* dfsph next to solids: pressure, and the force of water at rest on a fixed solid. */
#include "tests/sim/fixture.h"

#include "sim/cpu/cpu.h"
#include "sim/methods/dfsph/dfsph_private.h"
#include "sim/step/world.h"

/* A ball, or a disc, under viscous water. */
static WorldDef ball_def(int dimensions)
{
    WorldDef def = fixture_def(1.2, 1.4, dimensions == 3 ? 1 : 0);
    strcpy(def.method, "dfsph");
    def.dimensions = dimensions;
    def.spacing = dimensions == 3 ? 0.1 : 0.05;
    def.fluids[0].viscosity = dimensions == 3 ? 800 : 200; /* calm soon, and not too viscous for the step */
    dfsph_def(&def)->divergence_tolerance = 1e-5;
    fixture_block(&def, 0, -0.6, 0, -0.5, 0.6, 1.2, 0.5);
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 0.6, 0}, .radius = 0.3, .axis = {0, 1, 0}};
    return def;
}

typedef struct Rest {
    double lift; /* N */
    double near; /* mean of p - rho0 g depth next to the solid, over rho0 g H */
} Rest;

static double pressure_near(const WorldDef *def, World *world)
{
    State s = fixture_read(world);
    double mean = 0, top = 0, off = 0, touched = 0;
    for (size_t i = 0; i < s.count; i++) {
        mean += ((double)s.pressure[i] + 9810 * (double)s.position[4 * i + 1]) / (double)s.count;
        top = fmax(top, (double)s.position[4 * i + 1]);
    }
    for (size_t i = 0; i < s.count; i++) {
        const float *x = s.position + 4 * i;
        const double d[3] = {(double)x[0], (double)x[1] - def->solids[0].centre[1], (double)x[2]};
        if (solid_distance(&def->solids[0], def->dimensions, d) >= def->spacing)
            continue;
        off += (double)s.pressure[i] + 9810 * (double)x[1] - mean;
        touched++;
    }
    fixture_free(&s);
    assert_true(touched > 10);
    return off / touched / (9810 * top);
}

/* Means of the last steps: what is left of the start's gaps moves on. */
static Rest at_rest(const WorldDef *def)
{
    enum { STEPS = 100, TIMES = 10 };
    World *world = fixture_world(def);
    Rest rest = {0};
    Error error = {0};
    Forces forces;
    assert_true(world_enable_forces(world, &error));
    fixture_step(world, STEPS);
    world_forces(world, &forces);
    for (int k = 0; k < TIMES; k++) {
        fixture_step(world, 5);
        world_forces(world, &forces);
        rest.lift += forces.solid[0].force[1] / TIMES;
        rest.near += pressure_near(def, world) / TIMES;
    }
    world_destroy(world);
    return rest;
}

/* Boundary particles without a multiplier give 0.88 of the force, and pressure next to the ball is off by
   14 %. */
static void a_held_ball_has_the_lift_of_archimedes(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        const WorldDef def = ball_def(dimensions);
        const double r = def.solids[0].radius,
                     weight = 9810 * M_PI * r * r * (dimensions == 3 ? 4.0 / 3 * r : 1);
        const Rest rest = at_rest(&def);
        printf("%dD: lift %.3f of the weight of the water, pressure next to the ball off by %.2f %%\n",
               dimensions, rest.lift / weight, 100 * rest.near);
        assert_float_equal(rest.lift, weight, 0.07 * weight);
        assert_float_equal(rest.near, 0, 0.04);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_held_ball_has_the_lift_of_archimedes),
    };
    return cmocka_run_group_tests_name("dfsph.solids", tests, NULL, NULL);
}
