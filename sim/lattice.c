#include "sim/lattice.h"

#include <math.h>

void lattice_calibrate(double spacing, double support_radius, const Kernel *density_kernel,
                       const Kernel *pressure_kernel, Lattice *lattice)
{
    const double h = support_radius, volume = spacing * spacing * spacing;
    *lattice = (Lattice){.number_density = 1 / volume, .pressure_kernel = pressure_kernel};
    const int reach = (int)ceil(h / spacing);
    double sum = density_kernel->value(0, h), gradient = 0, laplacian = 0, compression = 0;

    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -reach; k <= reach; k++) {
                const double r = spacing * sqrt((double)(i * i + j * j + k * k));
                if (r == 0 || r >= h)
                    continue;
                lattice->neighbours++;
                sum += density_kernel->value(r, h);
                compression -= r * density_kernel->derivative(r, h) / 3; /* -d sum / d ln V */
                /* d(x)/dx = 1 = -sum V x_ij . grad W / 3; Laplacian of x^2 = 2 = sum V x_ij^2 lap W */
                gradient -= volume * r * pressure_kernel->derivative(r, h) / 3;
                laplacian += volume * r * r * kernel_viscosity_laplacian(r, h) / 3;
            }
    lattice->density_scale = lattice->number_density / sum;
    lattice->gradient_scale = gradient > 0 ? 1 / gradient : 1;
    lattice->stiffness_scale = compression > 0 ? sum / compression : 1;
    lattice->laplacian_scale = laplacian > 0 ? 2 / laplacian : 1;
}
