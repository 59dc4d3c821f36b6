#include "sim/kernel/sound_wave.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

enum { REACH = 4, SITES_MAX = (2 * REACH + 1) * (2 * REACH + 1) * (2 * REACH + 1) / 2, WAVES = 12 };

/* Half of the neighbours: opposite neighbours have the same part in a wave. */
typedef struct Sites {
    int dimensions, count;
    double x[SITES_MAX][3];                   /* spacings */
    double dense[SITES_MAX], push[SITES_MAX]; /* parts of D and P per length, 1/m2 */
} Sites;

static bool is_first_of_two(int i, int j, int k)
{
    return i > 0 || (i == 0 && (j > 0 || (j == 0 && k > 0)));
}

static void fill(Sites *sites, const Lattice *lattice, double spacing, double h, const Kernel *density_kernel,
                 bool carried)
{
    const Kernel *slope = lattice->pressure_kernel;
    const int reach = (int)fmin(ceil(h / spacing), REACH), deep = lattice->dimensions == 3 ? reach : 0;
    const double volume = 1 / lattice->number_density;
    sites->dimensions = lattice->dimensions;
    sites->count = 0;
    for (int i = 0; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -deep; k <= deep; k++) {
                const double r = spacing * sqrt((double)(i * i + j * j + k * k));
                if (!is_first_of_two(i, j, k) || r >= h)
                    continue;
                const int n = sites->count++;
                const double push = 2 * volume * lattice->gradient_scale * slope->derivative(r, h) / r;
                sites->x[n][0] = i, sites->x[n][1] = j, sites->x[n][2] = k;
                sites->push[n] = push * spacing;
                sites->dense[n] = carried ? push * spacing
                                          : 2 * volume * lattice->density_scale * lattice->stiffness_scale *
                                                density_kernel->derivative(r, h) / r * spacing;
            }
}

/* (omega / c)^2 of the wave with `phase` per spacing along each axis. */
static double stiffness(const Sites *sites, const double phase[3])
{
    double d[3] = {0}, p[3] = {0};
    for (int n = 0; n < sites->count; n++) {
        const double *x = sites->x[n], wave = sin(phase[0] * x[0] + phase[1] * x[1] + phase[2] * x[2]);
        for (int a = 0; a < 3; a++) {
            d[a] += sites->dense[n] * x[a] * wave;
            p[a] += sites->push[n] * x[a] * wave;
        }
    }
    return p[0] * d[0] + p[1] * d[1] + p[2] * d[2];
}

double sound_wave(const Lattice *lattice, double spacing, double support_radius, const Kernel *density_kernel,
                  bool carried, const double k[3])
{
    Sites sites;
    fill(&sites, lattice, spacing, support_radius, density_kernel, carried);
    return sqrt(fmax(0, stiffness(&sites, (double[3]){k[0] * spacing, k[1] * spacing, k[2] * spacing})));
}

/* Steps by `way` along the axes to better values until no step improves. */
static double climb(const Sites *sites, double phase[3], double way, double greatest)
{
    for (int a = 0; a < 2 * sites->dimensions; a++) {
        double next[3] = {phase[0], phase[1], phase[2]};
        next[a / 2] += a % 2 ? way : -way;
        const double found = stiffness(sites, next);
        if (found > greatest) {
            greatest = found;
            phase[a / 2] = next[a / 2];
            a = -1;
        }
    }
    return greatest;
}

double sound_stiffest(const Lattice *lattice, double spacing, double support_radius,
                      const Kernel *density_kernel, bool carried)
{
    Sites sites;
    double greatest = 0, best[3] = {0};
    fill(&sites, lattice, spacing, support_radius, density_kernel, carried);
    for (int i = 0; i <= WAVES; i++) /* a corner of the zone; the rest are mirror images */
        for (int j = 0; j <= i; j++)
            for (int k = 0; k <= (sites.dimensions == 3 ? j : 0); k++) {
                const double phase[3] = {PI * i / WAVES, PI * j / WAVES, PI * k / WAVES},
                             found = stiffness(&sites, phase);
                if (found > greatest) {
                    greatest = found;
                    for (int a = 0; a < 3; a++)
                        best[a] = phase[a];
                }
            }
    for (int halving = 1; halving < 16; halving++)
        greatest = climb(&sites, best, ldexp(PI / WAVES, -halving), greatest);
    return sqrt(greatest);
}
