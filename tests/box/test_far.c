/* Slow fluid far from the middle of a wide box goes where it would go in the middle (sim/box/box.h). */
#include "sim/box/box.h"
#include "sim/state.h"
#include "tests/sim/fixture.h"

enum { FAR = 4, STEPS = 400 };

static Error error;

/* Single particles in corners of a plane 400 spacings wide, each flying slowly: in half a step less than half
   of its place's last digit. */
static const double SLOW = 2e-4; /* m/s */
static const float places[3 * FAR] = {19.5F, 18.5F, 0, -19.5F, 18.5F, 0, 19.5F, 15, 0, -18, 17.25F, 0};
static const float velocities[3 * FAR] = {2e-4F, 2e-4F, 0, -2e-4F, -2e-4F, 0, 0, -2e-4F, 0, 2e-4F, 0, 0};

static WorldDef far_def(const char *method, InitialState *initial)
{
    WorldDef def = fixture_def(40, 20, 1);
    snprintf(def.method, sizeof def.method, "%s", method);
    def.dimensions = 2;
    def.support = 2.6;
    for (int k = 0; k < 3; k++)
        def.gravity[k] = 0;
    *initial = (InitialState){.count = FAR, .position = places, .velocity = velocities};
    def.initial = initial;
    return def;
}

static double digit_of(float x)
{
    return (double)(nextafterf(fabsf(x), INFINITY) - fabsf(x));
}

static void slow_particles_arrive(void **state)
{
    (void)state;
    for (int m = 0; m < 4; m++) {
        InitialState initial;
        const WorldDef def = far_def(fixture_method_names[m], &initial);
        World *world = fixture_world(&def);
        fixture_step(world, STEPS);
        State s = fixture_read(world);
        const double t = STEPS * def.dt;
        assert_true(SLOW * t > 50 * digit_of(places[0]));
        for (int i = 0; i < FAR; i++)
            for (int k = 0; k < 2; k++) {
                const float begun = places[3 * i + k];
                const double at = (double)begun + (double)velocities[3 * i + k] * t;
                if (!(fabs((double)s.position[4 * i + k] - at) < 0.51 * digit_of(begun)))
                    fail_msg("%s: particle %d along %d at %.9g, not %.9g, from %.9g", def.method, i, k,
                             (double)s.position[4 * i + k], at, (double)begun);
            }
        fixture_free(&s);
        world_destroy(world);
    }
}

/* Through the side at 20 m, in at the other. */
static void slow_particles_come_in_across(void **state)
{
    (void)state;
    InitialState initial;
    WorldDef def = far_def("mueller", &initial);
    const float near_side[3] = {19.99995F, 3, 0}, outward[3] = {2e-4F, 0, 0};
    initial = (InitialState){.count = 1, .position = near_side, .velocity = outward};
    def.periodic[0] = true;
    World *world = fixture_world(&def);
    fixture_step(world, STEPS);
    State s = fixture_read(world);
    const double at = (double)near_side[0] + (double)outward[0] * STEPS * def.dt - 40;
    assert_true(at < -19.999 && at > -20);
    if (!(fabs((double)s.position[0] - at) < 0.51 * digit_of(20)))
        fail_msg("at %.9g, not %.9g", (double)s.position[0], at);
    fixture_free(&s);
    world_destroy(world);
}

/* Fluid at rest in the world while the box glides or turns about the middle: the box's frame moves past
   the fluid. */
static void moving_boxes_lose_nothing(void **state)
{
    (void)state;
    enum { MANY = 2000 };
    static const double spin = 3e-6, dt = 0.001;
    BoxState begin = {.orientation = {0, 0, 0, 1},
                      .velocity = {1e-4, 0, 0},
                      .angular_velocity = {0, 0, spin}},
             end = begin;
    float x[3] = {19.5F, 3, 0}, left[3] = {0}, v[3] = {-1e-4F + 3 * (float)spin, -19.5F * (float)spin, 0};
    for (int n = 1; n <= MANY; n++) {
        BoxStep step;
        const double t = n * dt;
        end.position[0] = 1e-4 * t;
        end.orientation[2] = sin(0.5 * spin * t);
        end.orientation[3] = cos(0.5 * spin * t);
        box_step(&begin, &end, dt, &step);
        box_advance(&step, x, left, v);
        begin = end;
    }
    const double turned = spin * MANY * dt, dx = 19.5 - 1e-4 * MANY * dt;
    const double at[2] = {dx * cos(turned) + 3 * sin(turned), 3 * cos(turned) - dx * sin(turned)};
    for (int k = 0; k < 2; k++)
        if (!(fabs((double)x[k] - at[k]) < 2 * digit_of(x[k])))
            fail_msg("along %d at %.9g, not %.9g", k, (double)x[k], at[k]);
}

/* Saved, loaded and continued with remainders, the motion is the same: in each step the remainder is not
   0. */
static void what_rounding_leaves_is_a_part_of_the_state(void **state)
{
    (void)state;
    for (int m = 0; m < 4; m++) {
        InitialState initial;
        WorldState saved = {.count = 0};
        const WorldDef def = far_def(fixture_method_names[m], &initial);
        World *straight = fixture_world(&def), *loaded = fixture_world(&def);
        for (int i = 0; i < 60; i++) {
            if (i == 21)
                assert_true(world_save(straight, &saved, &error));
            fixture_step(straight, 1);
        }
        float most = 0;
        for (int i = 0; i < FAR; i++)
            most = fmaxf(most, fabsf(saved.particles.own[COLUMNS_LEFT][i]));
        assert_true(most > 0 && most <= 0.5F * (float)digit_of(places[0]));
        assert_true(world_load(loaded, &saved, &error));
        fixture_step(loaded, 60 - 21);
        assert_true(world_hash(straight) == world_hash(loaded));
        world_state_free(&saved);
        world_destroy(straight);
        world_destroy(loaded);
    }
}

/* Further backends lack the column, and a box becoming wide has the column from then on. */
static void narrow_boxes_keep_nothing(void **state)
{
    (void)state;
    InitialState initial;
    WorldState saved = {.count = 0};
    WorldDef def = far_def("mueller", &initial);
    const float middle[3] = {1, 3, 0};
    def.box_size[0] = 12.8;
    def.box_size[1] = 6;
    initial = (InitialState){.count = 1, .position = middle, .velocity = velocities};
    World *world = fixture_world(&def);
    assert_true(world_save(world, &saved, &error));
    assert_null(saved.particles.own[COLUMNS_LEFT]);
    world_state_free(&saved);
    def.box_size[0] = 12.9;
    assert_true(world_set_shapes(&world, &def, &error));
    fixture_step(world, 5);
    assert_true(world_save(world, &saved, &error));
    assert_true(saved.particles.own[COLUMNS_LEFT][0] != 0);
    world_state_free(&saved);
    world_destroy(world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slow_particles_arrive),
        cmocka_unit_test(slow_particles_come_in_across),
        cmocka_unit_test(moving_boxes_lose_nothing),
        cmocka_unit_test(what_rounding_leaves_is_a_part_of_the_state),
        cmocka_unit_test(narrow_boxes_keep_nothing),
    };
    return cmocka_run_group_tests_name("box.far", tests, NULL, NULL);
}
