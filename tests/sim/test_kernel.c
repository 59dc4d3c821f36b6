/* Kernels: unit integral, zero-sum gradient, positivity, with floating-point traps on. */
#define _GNU_SOURCE
#include "fixture.h"

#include "sim/kernel/kernel.h"

#include <fenv.h>

/* After: M. Mueller et al., 2003, eq. 22; infinite at r = 0. The program needs the Laplacian alone. */
static double kernel_viscosity(double r, double h)
{
    const double q = r / h;
    return q < 1 ? 15 / (2 * M_PI * h * h * h) * (q * q * (1 - 0.5 * q) + 0.5 / q - 1) : 0;
}

/* The kernels of both lists, and the kernel whose Laplacian the program uses. */
static Kernel kernels[16] = {{.name = "viscosity", .value = kernel_viscosity}};
static int kernel_count = 1;

static void add_kernels(const Kernel *list)
{
    for (; list->name; list++)
        kernels[kernel_count++] = *list;
}

static int traps_on(void **state)
{
    (void)state;
    return feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW) == -1;
}

static int traps_off(void **state)
{
    (void)state;
    return fedisableexcept(FE_ALL_EXCEPT) == -1;
}

static const double supports[] = {1e-4, 0.021, 1, 300};

static void integral_is_one(void **state)
{
    (void)state;
    for (int k = 0; k < kernel_count; k++)
        for (int s = 0; s < 4; s++) {
            const double h = supports[s];
            const int n = 20000;
            double sum = 0;
            for (int i = 0; i < n; i++) { /* shells, midpoint rule */
                const double r = (i + 0.5) / n * 1.2 * h;
                sum += 4 * M_PI * r * r * kernels[k].value(r, h) * 1.2 * h / n;
            }
            if (fabs(sum - 1) > 1e-6)
                fail_msg("%s at h = %g integrates to %.9f", kernels[k].name, h, sum);
        }
}

static void values_are_positive_and_end_at_h(void **state)
{
    (void)state;
    for (int k = 0; k < kernel_count; k++)
        for (int i = 1; i <= 3000; i++) {
            const double h = 0.3, r = i / 2000.0 * h, w = kernels[k].value(r, h);
            if (i < 2000 ? !(w > 0) : w != 0)
                fail_msg("%s at r = %g h is %g", kernels[k].name, r / h, w);
            assert_true(kernel_viscosity_laplacian(r, h) >= 0);
            assert_true(kernel_spiky_derivative(r, h) <= 0);
        }
}

/* The gradient summed over points mirrored in space is zero; and the derivative is that of the value. */
static void gradient_sums_to_zero(void **state)
{
    (void)state;
    uint32_t seed = 1;
    const double h = 0.21;
    for (int n = 0; n < kernel_count; n++) {
        if (!kernels[n].derivative)
            continue;
        double sum[3] = {0}, scale = 0;
        for (int i = 0; i < 1000; i++) {
            double x[3], r = 0;
            for (int k = 0; k < 3; k++) {
                x[k] = (2 * fixture_random(&seed) - 1) * h;
                r += x[k] * x[k];
            }
            r = sqrt(r);
            const double slope = kernels[n].derivative(r, h);
            for (int mirror = -1; mirror <= 1; mirror += 2)
                for (int k = 0; k < 3; k++)
                    sum[k] += slope * mirror * x[k] / r;
            scale += fabs(slope);
            if (r < 0.99 * h) {
                const double e = 1e-6 * h;
                const double difference = (kernels[n].value(r + e, h) - kernels[n].value(r - e, h)) / (2 * e);
                assert_true(fabs(slope - difference) <= 1e-6 * fabs(kernels[n].derivative(0.4 * h, h)));
            }
        }
        for (int k = 0; k < 3; k++)
            assert_true(fabs(sum[k]) <= 1e-12 * scale);
    }
}

/* W'' + 2 W' / r of the viscosity kernel, by differences. */
static void laplacian_is_that_of_the_kernel(void **state)
{
    (void)state;
    const double h = 0.7, e = 1e-4 * h;
    for (double r = 0.2 * h; r < 0.95 * h; r += 0.05 * h) {
        const double low = kernel_viscosity(r - e, h), mid = kernel_viscosity(r, h),
                     high = kernel_viscosity(r + e, h);
        const double laplacian = (high - 2 * mid + low) / (e * e) + (high - low) / (e * r);
        assert_true(fabs(laplacian - kernel_viscosity_laplacian(r, h)) <=
                    1e-3 * kernel_viscosity_laplacian(r, h));
    }
}

/* REFERENCE: 26 others strictly inside h at two spacings, 32 just above. */
static void lattice_has_its_neighbours(void **state)
{
    (void)state;
    Lattice lattice;
    lattice_calibrate(3, 0.01, 0.02, &density_kernels[0], &density_kernels[0], &lattice);
    assert_int_equal(lattice.neighbours, 26);
    lattice_calibrate(3, 0.01, 0.021, &density_kernels[0], &density_kernels[0], &lattice);
    assert_int_equal(lattice.neighbours, 32);
    /* sums over a fine lattice approach the integrals */
    lattice_calibrate(3, 0.01, 0.08, &density_kernels[0], &density_kernels[0], &lattice);
    assert_true(fabs(lattice.density_scale - 1) < 1e-2);
    assert_true(fabs(lattice.gradient_scale - 1) < 1e-2);
    assert_true(fabs(lattice.laplacian_scale - 1) < 1e-2);
    assert_true(fabs(lattice.stiffness_scale - 1) < 2e-2);
}

/* On the lattice the calibrated sums give the gradient of p = x, the Laplacian of v = y^2 and one particle a
   spacing^3, at any support; and squeezing it by 0.1 % changes n / n0 as stiffness_scale says. */
static void calibration_is_exact_on_the_lattice(void **state)
{
    (void)state;
    const double in_spacings[] = {1.6, 2.1, 2.6, 3.3}, s = 0.02, squeeze = 1e-3;
    for (const Kernel *kernel = density_kernels; kernel->name; kernel++)
        for (int n = 0; n < 4; n++) {
            const double h = in_spacings[n] * s, volume = s * s * s;
            Lattice lattice;
            lattice_calibrate(3, s, h, kernel, &density_kernels[0], &lattice);
            double density = kernel->value(0, h), squeezed = density, gradient = 0, laplacian = 0;
            for (int i = 0; i < 11 * 11 * 11; i++) {
                const double x = s * (i % 11 - 5), y = s * (i / 11 % 11 - 5), z = s * (i / 121 - 5);
                const double r = sqrt(x * x + y * y + z * z);
                if (r < 0.5 * s)
                    continue;
                density += kernel->value(r, h);
                squeezed += kernel->value(r * (1 - squeeze), h);
                gradient -= volume * x * kernel_spiky_derivative(r, h) * x / r;
                laplacian += volume * y * y * kernel_viscosity_laplacian(r, h);
            }
            const double change = pow(1 - squeeze, -3) - 1;
            assert_true(fabs(lattice.density_scale * density * volume - 1) < 1e-9);
            assert_true(fabs(lattice.gradient_scale * gradient - 1) < 1e-9);
            assert_true(fabs(lattice.laplacian_scale * laplacian - 2) < 1e-9);
            assert_true(fabs(lattice.stiffness_scale * (squeezed / density - 1) / change - 1) < 0.02);
        }
}

int main(void)
{
    add_kernels(density_kernels);
    add_kernels(shape_kernels);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(integral_is_one, traps_on, traps_off),
        cmocka_unit_test_setup_teardown(values_are_positive_and_end_at_h, traps_on, traps_off),
        cmocka_unit_test_setup_teardown(gradient_sums_to_zero, traps_on, traps_off),
        cmocka_unit_test_setup_teardown(laplacian_is_that_of_the_kernel, traps_on, traps_off),
        cmocka_unit_test_setup_teardown(lattice_has_its_neighbours, traps_on, traps_off),
        cmocka_unit_test_setup_teardown(calibration_is_exact_on_the_lattice, traps_on, traps_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
