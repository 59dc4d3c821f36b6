#include "sim/kernel/lattice.h"

#include <math.h>

void lattice_calibrate(int dimensions, double spacing, double support_radius, const Kernel *density_kernel,
                       const Kernel *pressure_kernel, Lattice *lattice)
{
    const double h = support_radius,
                 volume = dimensions == 3 ? spacing * spacing * spacing : spacing * spacing;
    *lattice =
        (Lattice){.dimensions = dimensions, .number_density = 1 / volume, .pressure_kernel = pressure_kernel};
    const int reach = (int)ceil(h / spacing), deep = dimensions == 3 ? reach : 0;
    double sum = density_kernel->value(0, h), gradient = 0, laplacian = 0, compression = 0, fourth = 0;

    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -deep; k <= deep; k++) {
                const double r = spacing * sqrt((double)(i * i + j * j + k * k));
                if (r == 0 || r >= h)
                    continue;
                lattice->neighbours++;
                sum += density_kernel->value(r, h);
                compression -= r * density_kernel->derivative(r, h) / dimensions; /* -d sum / d ln V */
                /* d(x)/dx = 1 = -sum V x_ij . grad W / 3; Laplacian of x^2 = 2 = sum V x_ij^2 lap W */
                gradient -= volume * r * pressure_kernel->derivative(r, h) / dimensions;
                fourth -= volume * r * r * r * pressure_kernel->derivative(r, h);
                laplacian += volume * r * r * kernel_viscosity_laplacian(r, h) / dimensions;
            }
    lattice->density_scale = lattice->number_density / sum;
    lattice->gradient_scale = gradient > 0 ? 1 / gradient : 1;
    lattice->radial_scale =
        fourth > 0 ? dimensions * (dimensions + 2) / (lattice->gradient_scale * fourth) : 0;
    lattice->stiffness_scale = compression > 0 ? sum / compression : 1;
    lattice->laplacian_scale = laplacian > 0 ? 2 / laplacian : 1;
}
