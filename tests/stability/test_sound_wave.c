/* The stiffest wave of the lattice: against sums over displaced particles, and against worlds that grow. */
#include "tests/sim/fixture.h"

#include "app/lab/stability.h"
#include "sim/kernel/kernel.h"
#include "sim/methods/wcsph/wcsph.h"

static const double PI = 3.14159265358979323846, A = 0.1; /* spacing, m */

static Lattice lattice_of(int dimensions, double support, const Kernel *kernel)
{
    Lattice lattice;
    lattice_calibrate(dimensions, A, support * A, kernel, kernel, &lattice);
    return lattice;
}

static void long_waves_travel_with_sound(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int carried = 0; carried < 2; carried++)
            for (int i = 0; i < SHAPE_KERNELS; i++) {
                const Kernel *kernel = &shape_kernels[i];
                const Lattice lattice = lattice_of(dimensions, 3, kernel);
                const double k = 0.05, wave[3] = {k / A, 0, 0};
                const double omega = sound_wave(&lattice, A, 3 * A, kernel, carried, wave);
                assert_true(fabs(omega * A / k - 1) < 0.01);
            }
}

enum { SIDE = 8 };

/* Of a periodic lattice of SIDE^3 particles, which the wave displaces: the acceleration of each against its
   displacement, by sums over all pairs. */
static double brute_omega2(const Lattice *lattice, double h, const Kernel *density, const double k[3])
{
    enum { COUNT = SIDE * SIDE * SIDE };
    static double at[COUNT][3], p[COUNT], u[COUNT][3];
    const double length = SIDE * A, small = 1e-5 * A, v = 1 / lattice->number_density;
    const double norm = sqrt(k[0] * k[0] + k[1] * k[1] + k[2] * k[2]);
    double up = 0, down = 0;
    for (int i = 0; i < COUNT; i++) {
        const int place[3] = {i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE)};
        const double x[3] = {place[0] * A, place[1] * A, place[2] * A};
        const double wave = cos(k[0] * x[0] + k[1] * x[1] + k[2] * x[2] + 0.3);
        for (int a = 0; a < 3; a++) {
            u[i][a] = small * k[a] / norm * wave;
            at[i][a] = x[a] + u[i][a];
        }
    }
    for (int forces = 0; forces < 2; forces++)
        for (int i = 0; i < COUNT; i++) {
            double n = lattice->density_scale * density->value(0, h), f[3] = {0};
            for (int j = 0; j < COUNT; j++) {
                double d[3], r2 = 0;
                for (int a = 0; a < 3; a++) {
                    d[a] = at[i][a] - at[j][a];
                    d[a] -= length * round(d[a] / length);
                    r2 += d[a] * d[a];
                }
                const double r = sqrt(r2);
                if (i == j || r >= h)
                    continue;
                n += lattice->density_scale * density->value(r, h);
                for (int a = 0; a < 3 && forces; a++)
                    f[a] -= v * (p[i] + p[j]) * lattice->gradient_scale *
                            lattice->pressure_kernel->derivative(r, h) * d[a] / r;
            }
            if (!forces)
                p[i] = lattice->stiffness_scale * (n * v - 1); /* over rho0 c^2 */
            for (int a = 0; a < 3; a++) {
                up -= f[a] * u[i][a];
                down += forces ? u[i][a] * u[i][a] : 0;
            }
        }
    return up / down;
}

static void waves_are_those_of_displaced_particles(void **state)
{
    (void)state;
    static const int waves[][3] = {{1, 0, 0}, {3, 0, 0}, {2, 2, 0}, {2, 2, 2}};
    const Kernel *spiky = density_kernel_find("spiky");
    const Lattice lattice = lattice_of(3, 2.1, spiky);
    for (size_t w = 0; w < sizeof waves / sizeof *waves; w++) {
        double k[3];
        for (int a = 0; a < 3; a++)
            k[a] = 2 * PI * waves[w][a] / (SIDE * A);
        const double omega = sound_wave(&lattice, A, 2.1 * A, spiky, false, k),
                     brute = brute_omega2(&lattice, 2.1 * A, spiky, k);
        assert_true(omega > 0 && fabs(omega * omega / brute - 1) < 1e-3);
    }
}

static double stiffest_in_box(const WorldDef *def)
{
    const MethodKernels kernels = method_kernels(def);
    const double h = def->support * def->spacing;
    double greatest = 0;
    Lattice lattice;
    lattice_calibrate(3, A, h, kernels.density, kernels.slope, &lattice);
    for (int i = 0; i <= SIDE / 2; i++)
        for (int j = 0; j <= i; j++)
            for (int k = 0; k <= j; k++) {
                const double to = 2 * PI / (SIDE * A), wave[3] = {i * to, j * to, k * to};
                greatest = fmax(greatest, sound_wave(&lattice, A, h, kernels.density,
                                                     method_find(def->method)->carries_density, wave));
            }
    return greatest;
}

/* Energy of motion over that at the start, of a periodic lattice with a little noise. */
static double growth(const char *method, double times)
{
    enum { COUNT = SIDE * SIDE * SIDE, STEPS = 20 };
    static float x[3 * COUNT], v[3 * COUNT];
    WorldDef def = fixture_def(SIDE * A, SIDE * A, SIDE * A);
    const InitialState initial = {.count = COUNT, .position = x, .velocity = v};
    uint32_t seed = 5;
    WorldSums before, after;
    snprintf(def.method, sizeof def.method, "%s", method);
    def.spacing = A;
    def.negative_pressure = true;
    def.sound_speed = 10;
    def.gravity[1] = 0;
    for (int k = 0; k < 3; k++)
        def.periodic[k] = true;
    wcsph_def(&def)->artificial_viscosity = 0;
    for (int i = 0; i < 3 * COUNT; i++) {
        const int place[3] = {i / 3 % SIDE, i / 3 / SIDE % SIDE, i / 3 / (SIDE * SIDE)};
        seed = seed * 1664525U + 1013904223U;
        x[i] = (float)((place[i % 3] + 0.5) * A - (i % 3 == 1 ? 0 : 0.5 * SIDE * A));
        v[i] = 1e-3F * ((float)(seed >> 8) / 0x1p24F - 0.5F);
    }
    def.initial = &initial;
    def.dt = times * 2 / (def.sound_speed * stiffest_in_box(&def));
    World *world = fixture_world(&def);
    world_sums(world, &before);
    fixture_step(world, STEPS);
    world_sums(world, &after);
    world_destroy(world);
    return after.kinetic_energy / before.kinetic_energy;
}

static void worlds_grow_beyond_it(void **state)
{
    (void)state;
    static const char *const methods[] = {"mueller", "wcsph"};
    for (int m = 0; m < 2; m++) {
        const double below = growth(methods[m], 0.98), beyond = growth(methods[m], 1.02);
        if (!(below < 20 && beyond > 1000))
            fail_msg("%s: energy of motion times %g below, %g beyond", methods[m], below, beyond);
    }
}

static void the_stiffest_is_the_greatest_of_all(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int i = 0; density_kernels[i].name; i++)
            for (int s = 0; s < 5; s++) {
                const double support = 2.1 + 0.47 * s;
                const Kernel *kernel = &density_kernels[i];
                Lattice lattice;
                lattice_calibrate(dimensions, A, support * A, kernel, density_kernel_find("spiky"), &lattice);
                const double most = sound_stiffest(&lattice, A, support * A, kernel, false);
                uint32_t seed = 3;
                double found = 0;
                for (int n = 0; n < 3000; n++) {
                    double k[3] = {0};
                    for (int a = 0; a < dimensions; a++) {
                        seed = seed * 1664525U + 1013904223U;
                        k[a] = 2 * PI / A * (double)(seed >> 8) / 0x1p24;
                    }
                    found = fmax(found, sound_wave(&lattice, A, support * A, kernel, false, k));
                }
                assert_true(found <= most * (1 + 1e-9) && found > 0.9 * most);
            }
}

static void limits_are_what_they_say(void **state)
{
    (void)state;
    WorldDef def = fixture_def(1, 1, 1);
    StableLimits limits;
    fixture_block(&def, 0, -0.5, 0, -0.5, 0.5, 0.5, 0.5);
    def.sound_speed = 20;
    stable_limits(&def, &limits);
    const double h = def.support * def.spacing;
    assert_true(isinf(limits.friction) && isinf(limits.viscous));
    assert_true(fabs(limits.lattice / limits.sound - 1) < 1e-12 && limits.sound > 0.7 * h / 20 &&
                limits.sound < 1.1 * h / 20);
    assert_true(fabs(limits.courant - 0.2 * h / 20) < 1e-12);
    assert_true(fabs(limits.force - 0.25 * sqrt(0.5 * h / 9.81)) < 1e-4);
    def.fluids[0].viscosity = 100;
    stable_limits(&def, &limits);
    assert_true(fabs(limits.viscous - 0.125 * 0.25 * h * h / 0.1) < 1e-12);
    const double dt = limits.lattice, omega = 2 / limits.sound, gamma = 2 / limits.friction;
    assert_true(fabs(omega * omega * dt * dt + 2 * gamma * dt - 4) < 1e-9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(long_waves_travel_with_sound),
        cmocka_unit_test(waves_are_those_of_displaced_particles),
        cmocka_unit_test(worlds_grow_beyond_it),
        cmocka_unit_test(the_stiffest_is_the_greatest_of_all),
        cmocka_unit_test(limits_are_what_they_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
