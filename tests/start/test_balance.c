/* Starts in balance: pressures of the first state against the weight above, and no motion afterwards; and
   starts without pressure. */
#include "tests/sim/fixture.h"

#include "sim/methods/wcsph/wcsph.h"
#include "sim/start/start.h"

static WorldDef tank_def(const char *method, double width, double height)
{
    WorldDef def = fixture_def(width, height, 0);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.dimensions = 2;
    def.spacing = 0.05;
    def.support = 2.6;
    def.sound_speed = 31.3;
    def.fluids[0].start = START_HYDROSTATIC;
    def.dt = method_find(method)->incompressible ? 0.002 : 0.0005;
    return def;
}

/* The root mean square of pressure less `weight` of each place, over `scale`. */
static double pressure_error(World *world, double (*weight)(const float x[3]), double scale)
{
    State s = fixture_read(world);
    double sum = 0;
    for (size_t i = 0; i < s.count; i++) {
        const double off = (double)s.pressure[i] - weight(s.position + 4 * i);
        sum += off * off / (double)s.count;
    }
    fixture_free(&s);
    return sqrt(sum) / scale;
}

/* At first, and later for methods with sound: for incompressible methods the rest is the tolerance. */
static void expect_balance(const WorldDef *def, double (*weight)(const float x[3]), double scale, double most)
{
    World *world = fixture_world(def);
    const double first = pressure_error(world, weight, scale);
    fixture_step(world, 100);
    const double later = fixture_incompressible(def) ? 0 : pressure_error(world, weight, scale);
    if (!(first < most) || !(later < most))
        fail_msg("%s: pressures off by %g at first, %g later", def->method, first, later);
    world_destroy(world);
}

static double of_column(const float x[3])
{
    return 9810 * (1 - (double)x[1]);
}

static void a_column_bears_its_weight(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        WorldDef def = tank_def(fixture_method_names[m], 0.5, 1.5);
        fixture_block(&def, 0, -0.25, 0, 0, 0.25, 1, 0);
        expect_balance(&def, of_column, 9810, m == 0 ? 0.12 : 0.01); /* mueller sums */
    }
}

static double of_layers(const float x[3])
{
    const double y = (double)x[1];
    return 9.81 * (y > 0.5 ? 500 * (1 - y) : 250 + 1000 * (0.5 - y));
}

static void layers_bear_theirs(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        WorldDef def = tank_def(fixture_method_names[m], 0.5, 1.5);
        def.fluid_count = 2;
        def.fluids[1] = def.fluids[0];
        def.fluids[1].density = 500;
        fixture_block(&def, 0, -0.25, 0, 0, 0.25, 0.5, 0);
        fixture_block(&def, 1, -0.25, 0.5, 0, 0.25, 1, 0);
        expect_balance(&def, of_layers, 7360, m == 0 ? 0.25 : 0.02);
    }
}

static double sideways(const float x[3])
{
    return 9810 * (0.5 + (double)x[0]);
}

static void gravity_may_act_sideways(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        WorldDef def = tank_def(fixture_method_names[m], 1.5, 0.5);
        def.gravity[0] = 9.81;
        def.gravity[1] = 0;
        fixture_block(&def, 0, -0.5, 0, 0, 0.75, 0.5, 0);
        expect_balance(&def, sideways, 12260, m == 0 ? 0.12 : 0.02);
    }
}

/* For such starts: true if the first state equals a start at rest, to the bit. */
static void expect_rest(WorldDef *def, const char *what)
{
    uint64_t hash[2];
    for (int k = 0; k < 2; k++) {
        def->fluids[0].start = k ? START_REST : START_HYDROSTATIC;
        World *world = fixture_world(def);
        fixture_step(world, 3);
        hash[k] = world_hash(world);
        world_destroy(world);
    }
    if (hash[0] != hash[1])
        fail_msg("%s, %s: does not start at rest", def->method, what);
}

static void nothing_presses_in_free_fall(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        WorldDef def = tank_def(fixture_method_names[m], 0.5, 1.5);
        fixture_block(&def, 0, -0.15, 0.5, 0, 0.15, 1, 0);
        World *world = fixture_world(&def);
        State s = fixture_read(world);
        for (size_t i = 0; i < s.count; i++)
            assert_float_equal(s.pressure[i], 0,
                               40); /* a thousandth of rho0 g times its height, and mueller's sums */
        fixture_free(&s);
        world_destroy(world);
    }
}

static void nothing_presses_without_gravity(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        WorldDef def = tank_def(fixture_method_names[m], 0.5, 1.5);
        fixture_block(&def, 0, -0.25, 0, 0, 0.25, 1, 0);
        def.gravity[1] = 0;
        expect_rest(&def, "no gravity");
    }
}

/* No way leads down for ever: a flow along a periodic axis has no pressure. */
static void nothing_presses_around_a_period(void **state)
{
    (void)state;
    WorldDef def = tank_def("wcsph", 1, 0.5);
    def.periodic[0] = true;
    def.gravity[0] = 3;
    def.gravity[1] = 0;
    fixture_block(&def, 0, -0.5, 0, 0, 0.5, 0.5, 0);
    World *world = fixture_world(&def);
    State s = fixture_read(world);
    for (size_t i = 0; i < s.count; i++)
        assert_float_equal(s.pressure[i], 0, 3);
    fixture_free(&s);
    world_destroy(world);
}

/* A dam has the pressure of the collapse: none at the free side, less than the weight on the floor. */
static void a_dam_leans_on_nothing(void **state)
{
    (void)state;
    WorldDef def = tank_def("wcsph", 3, 1.5);
    fixture_block(&def, 0, -1.5, 0, 0, -0.5, 1, 0);
    World *world = fixture_world(&def);
    State s = fixture_read(world);
    double side = 0, corner = 0;
    for (size_t i = 0; i < s.count; i++) {
        const double x = (double)s.position[4 * i], y = (double)s.position[4 * i + 1];
        if (x > -0.55)
            side = fmax(side, (double)s.pressure[i]);
        if (x < -1.45 && y < 0.05)
            corner = (double)s.pressure[i];
    }
    assert_true(side < 700);
    assert_true(corner > 0.55 * 9810 && corner < 0.85 * 9810);
    fixture_free(&s);
    world_destroy(world);
}

/* A full box gives way nowhere: finite, and its pressure grows downwards. */
static void a_full_box_holds(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        WorldDef def = tank_def(fixture_method_names[m], 0.5, 1);
        fixture_block(&def, 0, -0.25, 0, 0, 0.25, 1, 0);
        World *world = fixture_world(&def);
        fixture_step(world, 20);
        State s = fixture_read(world);
        for (size_t i = 0; i < s.count; i++)
            assert_true(isfinite(s.pressure[i]) && s.position[4 * i + 1] > 0 && s.position[4 * i + 1] < 1);
        fixture_free(&s);
        world_destroy(world);
    }
}

/* Around a disc the lattice leaves gaps: the packing has none, and fluid stays calm. */
static double mean_compression(World *world, int fluid, double density)
{
    State s = fixture_read(world);
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < s.count; i++)
        if (s.fluid[i] == (uint32_t)fluid) {
            sum += (double)s.density[i] / density - 1;
            count++;
        }
    fixture_free(&s);
    return sum / (double)count;
}

/* Two fluids filling the box sink from the lid under the weight: densities by position, the target of
   shifting, equal carried densities, and the box does not ring. */
static void a_full_box_sinks_from_its_lid(void **state)
{
    (void)state;
    WorldDef def = tank_def("wcsph", 0.5, 1);
    def.fluid_count = 2;
    def.fluids[0].density = 500;
    def.fluids[1] = def.fluids[0];
    def.fluids[1].density = 1000;
    fixture_block(&def, 0, -0.25, 0, 0, 0.25, 0.5, 0);
    fixture_block(&def, 1, -0.25, 0.5, 0, 0.25, 1, 0);
    wcsph_def(&def)->shifting = 0.2;
    World *world = fixture_world(&def);
    State s = fixture_read(world);
    double top = 0;
    for (size_t i = 0; i < s.count; i++)
        top = fmax(top, (double)s.position[4 * i + 1]);
    const double below = mean_compression(world, 0, 500);
    assert_float_equal(1 - 0.025 - top, 0.5 * (0.0122 + 0.0025), 0.001);
    for (int k = 0; k < 10; k++) {
        fixture_step(world, 40);
        assert_float_equal(mean_compression(world, 0, 500), below, 0.0015);
    }
    fixture_free(&s);
    world_destroy(world);
}

static void a_packing_around_solids(void **state)
{
    (void)state;
    WorldDef def = tank_def("wcsph", 1, 1.4);
    def.fluids[0].viscosity = 1;
    fixture_block(&def, 0, -0.5, 0, 0, 0.5, 1, 0);
    def.solid_count = 1;
    def.solids[0] = (SolidDef){.kind = SOLID_SPHERE, .centre = {0.02, 0.45, 0}, .radius = 0.2};
    World *world = fixture_world(&def);
    State s = fixture_read(world);
    double top = 0, near = INFINITY;
    for (size_t i = 0; i < s.count; i++) {
        const double x = (double)s.position[4 * i] - 0.02, y = (double)s.position[4 * i + 1];
        near = fmin(near, (hypot(x, y - 0.45) - 0.2) / 0.05);
        top = fmax(top, y);
    }
    if (!(near > 0.35))
        fail_msg("%g spacings from the disc", near);
    assert_true(top < 0.97); /* the surface sank by what the gaps hold */
    fixture_free(&s);
    double fastest = 0;
    for (int k = 0; k < 20; k++) {
        fixture_step(world, 20);
        s = fixture_read(world);
        for (size_t i = 0; i < s.count; i++)
            fastest = fmax(fastest, hypot((double)s.velocity[4 * i], (double)s.velocity[4 * i + 1]));
        fixture_free(&s);
    }
    if (!(fastest < 0.2))
        fail_msg("%g m/s", fastest);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_column_bears_its_weight),       cmocka_unit_test(layers_bear_theirs),
        cmocka_unit_test(gravity_may_act_sideways),        cmocka_unit_test(nothing_presses_in_free_fall),
        cmocka_unit_test(nothing_presses_without_gravity), cmocka_unit_test(nothing_presses_around_a_period),
        cmocka_unit_test(a_dam_leans_on_nothing),          cmocka_unit_test(a_full_box_holds),
        cmocka_unit_test(a_full_box_sinks_from_its_lid),   cmocka_unit_test(a_packing_around_solids),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
