/* Fluid started in balance, with gravity turned during the run: by the live key, by the hand, by a motion
   of the scene. The fluid sloshes to the new floor, gains no energy and comes to rest. */
#include "tests/lists.h"
#include "tests/sim/fixture.h"

static const double G = 9.81;

/* Half a box, viscous enough to be calm within seconds. */
static WorldDef tank_def(const char *method)
{
    WorldDef def = fixture_def(1, 1, 0);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.dimensions = 2;
    def.spacing = 0.05;
    def.support = 2.6;
    def.sound_speed = 45; /* ten times the fall through the box */
    def.fluids[0].start = START_HYDROSTATIC;
    def.fluids[0].viscosity = 100;
    def.dt = 0.008;
    def.substeps = strcmp(method, "pbf") == 0 ? 1 : method_find(method)->incompressible ? 4 : 16;
    def.retries = 3;
    fixture_block(&def, 0, -0.5, 0, 0, 0.5, 0.5, 0);
    return def;
}

/* What the fluid has, for each of its mass: mean place, m; energies of motion and of gravity in the box's
   frame, J/kg; greatest speed, m/s. */
typedef struct Look {
    double x, y, motion, fall, fastest;
} Look;

static Look look_at(World *world, double gx, double gy)
{
    State s = fixture_read(world);
    Look look = {0};
    for (size_t i = 0; i < s.count; i++) {
        const double v = hypot((double)s.velocity[4 * i], (double)s.velocity[4 * i + 1]);
        look.x += (double)s.position[4 * i] / (double)s.count;
        look.y += (double)s.position[4 * i + 1] / (double)s.count;
        look.motion += 0.5 * v * v / (double)s.count;
        look.fastest = fmax(look.fastest, v);
        assert_true(isfinite(v) && isfinite(s.pressure[i]));
    }
    look.fall = -gx * look.x - gy * look.y;
    fixture_free(&s);
    return look;
}

/* The root mean square of pressure less the weight above, of fluid half a box deep whose gravity is along x.
 */
static double pressure_error(World *world)
{
    State s = fixture_read(world);
    double sum = 0;
    for (size_t i = 0; i < s.count; i++) {
        const double off = (double)s.pressure[i] - 1000 * G * (double)s.position[4 * i];
        sum += off * off / (double)s.count;
    }
    fixture_free(&s);
    return sqrt(sum) / (1000 * G * 0.5);
}

/* At rest on the wall at x = 0.5, without a step that had to be made again. `most`: of the pressure's error.
 */
static void expect_calm(World *world, const char *method, const char *what, double most)
{
    const Look look = look_at(world, G, 0);
    WorldInfo info;
    world_info(world, &info);
    const double off = pressure_error(world);
    printf("%s, %s: centre %.4f %.4f, %.3g m/s rms, fastest %.3g, pressure off by %.3g\n", method, what,
           look.x, look.y, sqrt(2 * look.motion), look.fastest, off);
    assert_float_equal(look.x, 0.25, 0.01);
    assert_float_equal(look.y, 0.5, 0.01);
    assert_true(info.trouble.count == 0);
    assert_true(sqrt(2 * look.motion) < 0.03);
    assert_true(off < most);
}

/* For so many frames: single particles of a jet along a wall come to 1.7 times the speed of a fall through
   the whole box, none to twice; and without work by the box the energies of motion and of gravity gain
   nothing. */
static void slosh_for(World *world, int frames, bool moves)
{
    const double before = look_at(world, G, 0).fall;
    for (int k = 0; k < frames; k += 5) {
        fixture_step(world, 5);
        const Look look = look_at(world, G, 0);
        if (!(look.fastest < 2 * sqrt(2 * G)))
            fail_msg("%g m/s", look.fastest);
        if (!moves && !(look.motion + look.fall < before + 0.02 * G))
            fail_msg("energy grew by %g J/kg", look.motion + look.fall - before);
    }
}

/* 200 particles, no longer in the order of a lattice. */
static const double pressure_most[] = {0.2, 0.17, 0.12,
                                       0.25}; /* of pbf at a moment: 0.06 to 0.21 by the rounding */

/* The key, at once. */
static void gravity_turns_at_once(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        Error error = {{0}};
        WorldDef def = tank_def(fixture_method_names[m]);
        World *world = fixture_world(&def);
        fixture_step(world, 10);
        def.gravity[0] = G;
        def.gravity[1] = 0;
        assert_true(world_change(world, &def, &error));
        slosh_for(world, 650, false);
        expect_calm(world, def.method, "gravity turned", pressure_most[m]);
        world_destroy(world);
    }
}

/* None at first: what starts so is at rest, and falls when there is some. */
static void gravity_sets_in(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        Error error = {{0}};
        WorldDef def = tank_def(fixture_method_names[m]);
        def.gravity[1] = 0;
        World *world = fixture_world(&def);
        fixture_step(world, 10);
        assert_true(look_at(world, 0, 0).fastest < 1e-3);
        def.gravity[0] = G;
        assert_true(world_change(world, &def, &error));
        slosh_for(world, 650, false);
        expect_calm(world, def.method, "gravity set in", pressure_most[m]);
        world_destroy(world);
    }
}

/* The hand turns the box by a right angle as fast as it may, the other way round than gravity is seen to. */
static void the_hand_turns_the_box(void **state)
{
    (void)state;
    const BoxTarget target = {.orientation = {0, 0, -sqrt(0.5), sqrt(0.5)}};
    for (int m = 0; m < fixture_methods(); m++) {
        WorldDef def = tank_def(fixture_method_names[m]);
        World *world = fixture_world(&def);
        fixture_step(world, 10);
        world_set_target(world, &target);
        slosh_for(world, 600, true);
        expect_calm(world, def.method, "box turned by hand", pressure_most[m]);
        world_destroy(world);
    }
}

/* A motion of the scene, within a quarter of a second. */
static void a_motion_turns_the_box(void **state)
{
    (void)state;
    for (int m = 0; m < fixture_methods(); m++) {
        WorldDef def = tank_def(fixture_method_names[m]);
        add_motion(
            &def,
            (Motion){
                .kind = MOTION_TURN, .axis = {0, 0, -1}, .angle_deg = 90, .start = 0.1, .duration = 0.25});
        World *world = fixture_world(&def);
        slosh_for(world, 600, true);
        expect_calm(world, def.method, "box turned by the scene", pressure_most[m]);
        world_destroy(world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gravity_turns_at_once),
        cmocka_unit_test(gravity_sets_in),
        cmocka_unit_test(the_hand_turns_the_box),
        cmocka_unit_test(a_motion_turns_the_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
