#include "sim/kernel/kernel.h"

#include <math.h>
#include <string.h>

double kernel_poly6(double r, double h)
{
    const double q = r / h, t = 1 - q * q;
    return q < 1 ? 315 / (64 * M_PI * h * h * h) * t * t * t : 0;
}

double kernel_poly6_derivative(double r, double h)
{
    const double q = r / h, t = 1 - q * q;
    return q < 1 ? -945 / (32 * M_PI * h * h * h * h) * q * t * t : 0;
}

double kernel_spiky(double r, double h)
{
    const double t = 1 - r / h;
    return t > 0 ? 15 / (M_PI * h * h * h) * t * t * t : 0;
}

double kernel_spiky_derivative(double r, double h)
{
    const double t = 1 - r / h;
    return t > 0 ? -45 / (M_PI * h * h * h * h) * t * t : 0;
}

double kernel_viscosity(double r, double h)
{
    const double q = r / h;
    return q < 1 ? 15 / (2 * M_PI * h * h * h) * (q * q * (1 - 0.5 * q) + 0.5 / q - 1) : 0;
}

double kernel_viscosity_laplacian(double r, double h)
{
    const double t = 1 - r / h;
    return t > 0 ? 45 / (M_PI * h * h * h * h * h) * t : 0;
}

double kernel_cubic(double r, double h)
{
    const double q = r / h, t = 1 - q, scale = 8 / (M_PI * h * h * h);
    return q < 0.5 ? scale * (1 - 6 * q * q * t) : q < 1 ? scale * 2 * t * t * t : 0;
}

double kernel_cubic_derivative(double r, double h)
{
    const double q = r / h, t = 1 - q, scale = 8 / (M_PI * h * h * h * h);
    return q < 0.5 ? scale * (18 * q * q - 12 * q) : q < 1 ? -scale * 6 * t * t : 0;
}

double kernel_wendland_c2(double r, double h)
{
    const double q = r / h, t = 1 - q;
    return q < 1 ? 21 / (2 * M_PI * h * h * h) * t * t * t * t * (1 + 4 * q) : 0;
}

double kernel_wendland_c2_derivative(double r, double h)
{
    const double q = r / h, t = 1 - q;
    return q < 1 ? -21 / (2 * M_PI * h * h * h * h) * 20 * q * t * t * t : 0;
}

/* The three terms of the quintic: 1, -6 and 15 times the power of 3, 2 and 1 minus 3 q. */
static double quintic_terms(double q, double power)
{
    const double a = 3 - 3 * q, b = 2 - 3 * q, c = 1 - 3 * q;
    return (a > 0 ? pow(a, power) : 0) - (b > 0 ? 6 * pow(b, power) : 0) + (c > 0 ? 15 * pow(c, power) : 0);
}

double kernel_quintic(double r, double h)
{
    return 27 / (120 * M_PI * h * h * h) * quintic_terms(r / h, 5);
}

double kernel_quintic_derivative(double r, double h)
{
    return -27 * 15 / (120 * M_PI * h * h * h * h) * quintic_terms(r / h, 4);
}

const Kernel shape_kernels[] = {
    [KERNEL_CUBIC] = {"cubic", "cubic spline", kernel_cubic, kernel_cubic_derivative},
    [KERNEL_WENDLAND_C2] = {"wendland_c2", "Wendland C2: no pairing, wants support 3", kernel_wendland_c2,
                            kernel_wendland_c2_derivative},
    [KERNEL_QUINTIC] = {"quintic", "quintic spline: smoothest, wants support 3", kernel_quintic,
                        kernel_quintic_derivative},
    [SHAPE_KERNELS] = {0},
};

const Kernel density_kernels[] = {
    {"spiky", "the kernel of the pressure force too: energy is conserved", kernel_spiky,
     kernel_spiky_derivative},
    {"poly6", "as in Müller 2003: pumps energy into the fluid, needs viscosity", kernel_poly6,
     kernel_poly6_derivative},
    {0},
};

static const Kernel *find(const Kernel *kernel, const char *name)
{
    while (kernel->name && strcmp(kernel->name, name) != 0)
        kernel++;
    return kernel->name ? kernel : NULL;
}

const Kernel *density_kernel_find(const char *name)
{
    return find(density_kernels, name);
}

const Kernel *shape_kernel_find(const char *name)
{
    return find(shape_kernels, name);
}
