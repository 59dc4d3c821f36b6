/* What a start has by formula: velocities, and where a fill ends. */
#include "tests/lists.h"
#include "tests/sim/fixture.h"

static WorldDef tank_def(double width, double height)
{
    WorldDef def = fixture_def(width, height, 0);
    def.dimensions = 2;
    def.spacing = 0.05;
    return def;
}

static void velocities_by_formula(void **state)
{
    (void)state;
    WorldDef def = tank_def(1, 1);
    def.fluids[0].velocity[1] = 0.5;
    strcpy(def.fluids[0].flow[0], "2 * y");
    strcpy(def.fluids[0].flow[1], "sin(pi * x)");
    fixture_block(&def, 0, -0.5, 0, 0, 0.5, 0.5, 0);
    World *world = fixture_world(&def);
    State s = fixture_read(world);
    for (size_t i = 0; i < s.count; i++) {
        const double x = (double)s.position[4 * i], y = (double)s.position[4 * i + 1];
        assert_float_equal(s.velocity[4 * i], 2 * y, 1e-5);
        assert_float_equal(s.velocity[4 * i + 1], 0.5 + sin(M_PI * x), 1e-5);
    }
    fixture_free(&s);
    world_destroy(world);
    strcpy(def.fluids[0].flow[0], "1 / (x - x)");
    Error error = {{0}};
    assert_null(world_create(&def, &error));
    assert_non_null(strstr(error.message, "has no value"));
    strcpy(def.fluids[0].flow[0], "1e30 * x");
    assert_null(world_create(&def, &error));
    assert_non_null(strstr(error.message, "at most 1000 along an axis can be"));
}

/* The same slope and shear by table as by formula: the same bits. */
static void by_table_as_by_formula(void **state)
{
    (void)state;
    double x[2] = {-2, 2}, y[2] = {-1, 3}, height[2] = {0, 1}, speed[2] = {-2, 6};
    const FieldTable heights = {.count = {2, 1, 1}, .place = {x}, .value = {height}},
                     speeds = {.count = {1, 2, 1}, .place = {NULL, y}, .value = {speed}};
    uint64_t hash[2];
    for (int k = 0; k < 2; k++) {
        WorldDef def = tank_def(1, 1);
        fixture_block(&def, 0, -0.5, 0, 0, 0.5, 1, 0);
        if (k) {
            Fill *fill = own_fills(&def.fluids[0]);
            fill->heights = &heights;
            fill->below = "heights.csv";
            def.fluids[0].flow_table = &speeds;
        } else {
            own_fills(&def.fluids[0])->below = "0.5 + 0.25 * x";
            strcpy(def.fluids[0].flow[0], "2 * y");
        }
        World *world = fixture_world(&def);
        hash[k] = world_hash(world);
        world_destroy(world);
    }
    assert_int_equal(hash[0], hash[1]);
}

/* A wave a tenth of a spacing high, above a fluid or below empty space: nearby layers follow, layers at
   the floor do not, and compression is small. */
static void a_surface_by_formula(void **state)
{
    (void)state;
    for (int fluids = 1; fluids <= 2; fluids++) {
        WorldDef def = tank_def(1, 1.2);
        def.fluid_count = fluids;
        def.fluids[1] = def.fluids[0];
        fixture_block(&def, 0, -0.5, 0, 0, 0.5, 1, 0);
        if (fluids > 1)
            fixture_block(&def, 1, -0.5, 0, 0, 0.5, 1, 0);
        own_fills(&def.fluids[0])->below = "0.6 + 0.005 * cos(2 * pi * x)";
        World *world = fixture_world(&def);
        State s = fixture_read(world);
        double next = 0, floor_ = 0;
        size_t below = 0;
        for (size_t i = 0; i < s.count; i++) {
            const double y = (double)s.position[4 * i + 1], wave = cos(2 * M_PI * (double)s.position[4 * i]);
            below += s.fluid[i] == 0;
            if (s.fluid[i] == 0 && y > 0.55)
                next += 2 * (y - 0.575) * wave / 20;
            if (y < 0.05)
                floor_ += 2 * (y - 0.025) * wave / 20;
        }
        assert_int_equal(below, 20 * 12);
        assert_float_equal(next, 0.0043, 0.0006);
        assert_float_equal(floor_, 0, 0.0002);
        fixture_free(&s);
        world_destroy(world);
    }
}

/* A slope of many steps: as many particles as it has room for, and the uppermost stand in line. */
static void a_slope_by_formula(void **state)
{
    (void)state;
    WorldDef def = tank_def(2, 1.2);
    fixture_block(&def, 0, -1, 0, 0, 1, 1, 0);
    own_fills(&def.fluids[0])->below = "0.5 + 0.25 * x";
    World *world = fixture_world(&def);
    State s = fixture_read(world);
    double top[40] = {0};
    assert_float_equal((double)s.count * 0.0025, 1, 0.02);
    for (size_t i = 0; i < s.count; i++) {
        const int column = (int)((1 + (double)s.position[4 * i]) / 0.05);
        assert_in_range(column, 0, 39);
        top[column] = fmax(top[column], (double)s.position[4 * i + 1]);
    }
    for (int k = 0; k < 40; k++) {
        const double wanted = 0.5 + 0.25 * (-1 + 0.05 * (k + 0.5)) - 0.025;
        assert_float_equal(top[k], wanted, 0.02);
    }
    fixture_free(&s);
    world_destroy(world);
}

/* Between fluids filling the box: displaced places without a neighbour straight behind a face are no
   surface, and the light fluid bears the heavy fluid, 4905 Pa, from the start. */
static void an_interface_by_formula_is_none_to_the_weight(void **state)
{
    (void)state;
    WorldDef def = tank_def(0.5, 1);
    snprintf(def.method, sizeof def.method, "wcsph");
    def.spacing = 0.0125;
    def.sound_speed = 31.3;
    def.fluid_count = 2;
    def.fluids[0].start = START_HYDROSTATIC;
    def.fluids[1] = def.fluids[0];
    def.fluids[0].density = 500;
    fixture_block(&def, 0, -0.25, 0, 0, 0.25, 1, 0);
    fixture_block(&def, 1, -0.25, 0, 0, 0.25, 1, 0);
    own_fills(&def.fluids[0])->below = "0.5 - 0.01 * cos(4 * pi * x)";
    World *world = fixture_world(&def);
    State s = fixture_read(world);
    for (size_t i = 0; i < s.count; i++) {
        const double y = (double)s.position[4 * i + 1];
        if (fabs(y - 0.5) > 0.1)
            assert_float_equal(s.pressure[i], y > 0.5 ? 9810 * (1 - y) : 4905 + 4905 * (0.5 - y), 150);
    }
    fixture_free(&s);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(velocities_by_formula),
        cmocka_unit_test(by_table_as_by_formula),
        cmocka_unit_test(a_surface_by_formula),
        cmocka_unit_test(a_slope_by_formula),
        cmocka_unit_test(an_interface_by_formula_is_none_to_the_weight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
