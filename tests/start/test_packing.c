/* Pressure next to a round solid in a tank at rest, of a method whose particles carry their density and
   nothing levels it: sim/start/start.h. */
#include "tests/lists.h"
#include "tests/sim/fixture.h"

#include "sim/methods/wcsph/wcsph.h"

static const double RADIUS = 0.2, DEEP = 0.6; /* of the solid, and of its centre below the surface, m */

static WorldDef tank(void)
{
    WorldDef def = fixture_def(1, 1.2, 1);
    def.dimensions = 2;
    snprintf(def.method, sizeof def.method, "wcsph");
    snprintf(wcsph_def(&def)->kernel, sizeof wcsph_def(&def)->kernel, "wendland_c2");
    def.spacing = 0.025;
    def.support = 3.5;
    def.sound_speed = 31.3; /* ten times sqrt(g H) */
    def.dt = 0.3 * def.support * def.spacing / def.sound_speed;
    wcsph_def(&def)->artificial_viscosity = 0.02;
    wcsph_def(&def)->delta_sph = 0;
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 1, 0.5);
    def.fluids[0].start = START_HYDROSTATIC;
    def.solids[def.solid_count++] =
        (SolidDef){.kind = SOLID_SPHERE, .centre = {0, 1 - DEEP, 0}, .radius = RADIUS};
    return def;
}

/* Pressure within a spacing of the solid less the hydrostatic one, whose mean all the fluid gives, over rho0
 * g H. */
static double off_next_to_it(World *world, const WorldDef *def)
{
    State s = fixture_read(world);
    double mean = 0, off = 0;
    int near = 0;
    for (size_t i = 0; i < s.count; i++)
        mean += ((double)s.pressure[i] + 9810 * (double)s.position[4 * i + 1]) / (double)s.count;
    for (size_t i = 0; i < s.count; i++) {
        const float *x = s.position + 4 * i;
        const double y = (double)x[1] - (1 - DEEP), across = hypot((double)x[0], (double)x[2]);
        if (hypot(across, y) > RADIUS + def->spacing)
            continue;
        off += ((double)s.pressure[i] + 9810 * (double)x[1] - mean) / 9810;
        near++;
    }
    fixture_free(&s);
    assert_true(near > 30);
    return off / near;
}

static void pressure_next_to_a_round_solid_is_that_of_the_fluid(void **state)
{
    (void)state;
    fixture_needs_cpu("the start is the same");
    const WorldDef def = tank();
    World *world = fixture_world(&def);
    double off = 0;
    const int reads = 10, frames = (int)(0.4 / def.dt / reads);
    for (int k = 0; k < reads; k++) {
        fixture_step(world, frames);
        off += k < reads / 2 ? 0 : off_next_to_it(world, &def) / (reads - reads / 2);
    }
    printf("pressure next to the solid off by %.2f %% of rho0 g H\n", 100 * off);
    assert_true(fabs(off) < 0.03);
    world_destroy(world);
}

/* The start with the tank's right half another fluid. */
static State of_halves(int left, int right)
{
    WorldDef def = tank();
    def.fluid_count = 2;
    def.fluids[1] = def.fluids[0];
    own_fills(&def.fluids[0])->max[0] = own_fills(&def.fluids[1])->min[0] = 0;
    snprintf(def.fluids[1].name, sizeof def.fluids[1].name, "right");
    def.fluids[0].start = left;
    def.fluids[1].start = right;
    World *world = fixture_world(&def);
    State s = fixture_read(world);
    world_destroy(world);
    return s;
}

/* How far particles of a fluid are apart in two starts at most, along an axis, spacings. */
static double moved(const State *one, const State *other, uint32_t fluid)
{
    double most = 0;
    for (size_t i = 0; i < one->count; i++)
        for (size_t k = 0; k < 2 && one->fluid[i] == fluid; k++)
            most = fmax(most, fabs((double)(one->position[4 * i + k] - other->position[4 * i + k])));
    return most / tank().spacing;
}

static void fluid_that_starts_at_rest_stays(void **state)
{
    (void)state;
    fixture_needs_cpu("the start is the same");
    State lattice = of_halves(START_REST, START_REST), half = of_halves(START_HYDROSTATIC, START_REST);
    printf("packed by %.3g spacings, by %.3g at rest\n", moved(&half, &lattice, 0),
           moved(&half, &lattice, 1));
    assert_int_equal(half.count, lattice.count);
    assert_true(moved(&half, &lattice, 0) > 0.2);
    assert_true(moved(&half, &lattice, 1) == 0);
    fixture_free(&lattice);
    fixture_free(&half);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pressure_next_to_a_round_solid_is_that_of_the_fluid),
        cmocka_unit_test(fluid_that_starts_at_rest_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
