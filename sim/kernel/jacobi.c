#include "sim/kernel/jacobi.h"

#include <math.h>

typedef struct Sums {
    double sum[3], squares;
} Sums;

/* Sums for a wave with phase `wave` per spacing. */
static Sums wave_sums(const Kernel *kernel, int dimensions, double spacing, double h, const double wave[3])
{
    const int reach = (int)ceil(h / spacing), deep = dimensions == 3 ? reach : 0;
    Sums s = {0};
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -deep; k <= deep; k++) {
                const double r = spacing * sqrt((double)(i * i + j * j + k * k));
                if (r == 0 || r >= h)
                    continue;
                const double slope = -kernel->derivative(r, h);
                const double part = slope / r * spacing * sin(wave[0] * i + wave[1] * j + wave[2] * k);
                s.sum[0] += part * i, s.sum[1] += part * j, s.sum[2] += part * k;
                s.squares += slope * slope;
            }
    return s;
}

JacobiLattice jacobi_lattice(const Kernel *kernel, int dimensions, double spacing, double h)
{
    enum { WAVES = 12 };
    JacobiLattice lattice = {0};
    for (int i = 0; i <= WAVES; i++)
        for (int j = 0; j <= i; j++)
            for (int k = 0; k <= (dimensions == 3 ? j : 0); k++) {
                const double wave[3] = {M_PI * i / WAVES, M_PI * j / WAVES, M_PI * k / WAVES};
                const Sums s = wave_sums(kernel, dimensions, spacing, h, wave);
                const double *x = s.sum;
                lattice.squares = s.squares;
                lattice.greatest =
                    fmax(lattice.greatest, (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / s.squares);
            }
    return lattice;
}
