#include "sim/kernel.h"

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

const Kernel density_kernels[] = {
    {"spiky", "the kernel of the pressure force too: energy is conserved", kernel_spiky,
     kernel_spiky_derivative},
    {"poly6", "as in Müller 2003: pumps energy into the fluid, needs viscosity", kernel_poly6,
     kernel_poly6_derivative},
    {0},
};

const Kernel *density_kernel_find(const char *name)
{
    for (const Kernel *kernel = density_kernels; kernel->name; kernel++)
        if (strcmp(kernel->name, name) == 0)
            return kernel;
    return NULL;
}
