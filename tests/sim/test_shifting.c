/* Shifting of particles (sim/methods/wcsph/wcsph_passes.c): the shift against all pairs, and the effect
   of walls, surfaces and carried density. backend compute is compared with cpu in tests/gl. */
#include "fixture.h"

#include "sim/kernel/kernel.h"
#include "sim/methods/wcsph/wcsph.h"

enum { WIDE = 12, HIGH = 10, ALL = WIDE * HIGH };
static const double H = 0.3, SOUND = 15;

static float x0[3 * ALL], density0[ALL];

/* 12 x 10 particles that fill a box in the plane; off their lattice by `scatter` spacings at most. */
static WorldDef def_of(double scatter, bool periodic, double shifting)
{
    static InitialState initial;
    uint32_t seed = 3;
    WorldDef def = fixture_def(0.1 * WIDE, 0.1 * HIGH, 1);
    def.dimensions = 2;
    def.support = 3;
    def.sound_speed = SOUND;
    wcsph_def(&def)->shifting = shifting;
    def.negative_pressure = true;
    def.periodic[0] = def.periodic[1] = periodic;
    snprintf(def.method, sizeof def.method, "wcsph");
    snprintf(wcsph_def(&def)->kernel, sizeof wcsph_def(&def)->kernel, "wendland_c2");
    memset(def.gravity, 0, sizeof def.gravity);
    for (int i = 0; i < ALL; i++) {
        const int row = i / WIDE;
        x0[3 * i] = (float)(0.1 * (i % WIDE) - 0.55 + 0.1 * scatter * (2 * fixture_random(&seed) - 1));
        x0[3 * i + 1] = (float)(0.1 * row + 0.05 + 0.1 * scatter * (2 * fixture_random(&seed) - 1));
        density0[i] = 1000;
    }
    initial = (InitialState){.count = ALL, .position = x0, .density = density0};
    def.initial = &initial;
    return def;
}

/* What a step of `dt` s with shifting moves particles further than one without. */
static void shift_of(double scatter, bool periodic, double shifting, double dt, double shift[ALL][2])
{
    State states[2];
    for (int k = 0; k < 2; k++) {
        WorldDef def = def_of(scatter, periodic, k ? shifting : 0);
        def.dt = dt;
        World *world = fixture_world(&def);
        fixture_step(world, 1);
        states[k] = fixture_read(world);
        world_destroy(world);
    }
    for (size_t i = 0; i < ALL; i++)
        for (size_t k = 0; k < 2; k++) {
            const double off = (double)states[1].position[4 * i + k] - (double)states[0].position[4 * i + k],
                         size = 0.1 * (k ? HIGH : WIDE);
            shift[i][k] = periodic ? off - size * rint(off / size) : off;
        }
    fixture_free(&states[0]);
    fixture_free(&states[1]);
}

/* Sum of F x_ij over the nearest images, faded where less than 0.95 of the space is full; over n0. */
static void brute_shift(int i, double out[2])
{
    const Kernel *kernel = shape_kernel_find("wendland_c2");
    Lattice lattice;
    double full = 0;
    lattice_calibrate(2, 0.1, H, kernel, kernel, &lattice);
    out[0] = out[1] = 0;
    for (int j = 0; j < ALL; j++) {
        double dx = (double)x0[3 * i] - (double)x0[3 * j], dy = (double)x0[3 * i + 1] - (double)x0[3 * j + 1];
        dx -= 0.1 * WIDE * rint(dx / (0.1 * WIDE));
        dy -= 0.1 * HIGH * rint(dy / (0.1 * HIGH));
        const double r = hypot(dx, dy);
        if (j == i || r >= H)
            continue;
        const double f = -kernel->derivative(r, H) / r * lattice.gradient_scale / lattice.number_density;
        out[0] += f * dx;
        out[1] += f * dy;
        full += f * r * r / 2;
    }
    const double share = fmin(fmax((full - 0.8) / 0.15, 0), 1);
    out[0] *= share;
    out[1] *= share;
}

static void shifts_go_down_the_gradient(void **state)
{
    (void)state;
    static double shift[ALL][2];
    const double chi = 0.2, scale = chi * SOUND * 0.5 * H * 1e-3;
    double most = 0, worst = 0;
    shift_of(0.3, true, chi, 1e-3, shift);
    for (int i = 0; i < ALL; i++) {
        double right[2];
        brute_shift(i, right);
        for (int k = 0; k < 2; k++) {
            most = fmax(most, scale * fabs(right[k]));
            worst = fmax(worst, fabs(shift[i][k] - scale * right[k]));
        }
    }
    assert_true(most > 2e-4 && most < 0.01);
    if (!(worst < 2e-3 * most))
        fail_msg("shifts differ by %g m from up to %g m", worst, most);
}

static void no_shift_is_longer_than_a_tenth_of_a_spacing(void **state)
{
    (void)state;
    static double shift[ALL][2];
    double most = 0;
    shift_of(0.49, true, 1, 2e-3, shift);
    for (int i = 0; i < ALL; i++)
        most = fmax(most, fmax(fabs(shift[i][0]), fabs(shift[i][1])));
    assert_float_equal(most, 0.01, 1e-6);
}

/* The walls go on with the lattice: without them the outer layers would go a tenth of a spacing at them. */
static void walls_hold_what_fills_the_box(void **state)
{
    (void)state;
    static double shift[ALL][2];
    shift_of(0, false, 1, 1e-3, shift);
    for (int i = 0; i < ALL; i++)
        for (int k = 0; k < 2; k++)
            assert_float_equal(shift[i][k], 0, 2e-4);
}

/* A block amid a larger box: its outermost layer stays, and so its shape. */
static void surfaces_are_spared(void **state)
{
    (void)state;
    State states[2];
    for (int k = 0; k < 2; k++) {
        WorldDef def = def_of(0.2, false, k);
        def.box_size[0] = def.box_size[1] = 4;
        def.dt = 1e-3;
        for (int i = 0; i < ALL; i++)
            x0[3 * i + 1] += 1.5F;
        World *world = fixture_world(&def);
        fixture_step(world, 1);
        states[k] = fixture_read(world);
        world_destroy(world);
    }
    double inside = 0;
    for (int i = 0; i < ALL; i++) {
        const bool outer = i < WIDE || i >= ALL - WIDE || i % WIDE == 0 || i % WIDE == WIDE - 1;
        for (int k = 0; k < 2; k++) {
            const double off = (double)states[1].position[4 * i + k] - (double)states[0].position[4 * i + k];
            if (outer)
                assert_float_equal(off, 0, 1e-6);
            inside = fmax(inside, fabs(off));
        }
    }
    assert_true(inside > 1e-3);
    fixture_free(&states[0]);
    fixture_free(&states[1]);
}

/* A lattice with 1 % too much carried density: the error decays as exp(-t c / (20 h)). */
static void density_returns_to_that_of_the_places(void **state)
{
    (void)state;
    const double time = 20 * H / SOUND;
    for (int k = 0; k < 2; k++) {
        WorldDef def = def_of(0, true, k ? 0.2 : 0);
        for (int i = 0; i < ALL; i++)
            density0[i] = 1010;
        def.dt = time / 400;
        World *world = fixture_world(&def);
        fixture_step(world, 400);
        State s = fixture_read(world);
        for (int i = 0; i < ALL; i++)
            assert_float_equal(s.density[i], 1000 + 10 * (k ? exp(-1) : 1), 0.1);
        fixture_free(&s);
        world_destroy(world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shifts_go_down_the_gradient),
        cmocka_unit_test(no_shift_is_longer_than_a_tenth_of_a_spacing),
        cmocka_unit_test(walls_hold_what_fills_the_box),
        cmocka_unit_test(surfaces_are_spared),
        cmocka_unit_test(density_returns_to_that_of_the_places),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
