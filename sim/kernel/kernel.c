#include "sim/kernel/kernel.h"

#include <math.h>
#include <string.h>

double kernel_poly6(double r, double h)
{
    const double q = r / h, t = 1 - q * q;
    return q < 1 ? 315 / (64 * M_PI * h * h * h) * t * t * t : 0;
}

static double poly6_derivative(double r, double h)
{
    const double q = r / h, t = 1 - q * q;
    return q < 1 ? -945 / (32 * M_PI * h * h * h * h) * q * t * t : 0;
}

/* Eq. 21 of Müller 2003. */
static double spiky(double r, double h)
{
    const double t = 1 - r / h;
    return t > 0 ? 15 / (M_PI * h * h * h) * t * t * t : 0;
}

double kernel_spiky_derivative(double r, double h)
{
    const double t = 1 - r / h;
    return t > 0 ? -45 / (M_PI * h * h * h * h) * t * t : 0;
}

double kernel_viscosity_laplacian(double r, double h)
{
    const double t = 1 - r / h;
    return t > 0 ? 45 / (M_PI * h * h * h * h * h) * t : 0;
}

/* Cubic spline: Monaghan and Lattanzio 1985. */
static double cubic(double r, double h)
{
    const double q = r / h, t = 1 - q, scale = 8 / (M_PI * h * h * h);
    return q < 0.5 ? scale * (1 - 6 * q * q * t) : q < 1 ? scale * 2 * t * t * t : 0;
}

static double cubic_derivative(double r, double h)
{
    const double q = r / h, t = 1 - q, scale = 8 / (M_PI * h * h * h * h);
    return q < 0.5 ? scale * (18 * q * q - 12 * q) : q < 1 ? -scale * 6 * t * t : 0;
}

/* Wendland 1995; Dehnen and Aly 2012. */
static double wendland_c2(double r, double h)
{
    const double q = r / h, t = 1 - q;
    return q < 1 ? 21 / (2 * M_PI * h * h * h) * t * t * t * t * (1 + 4 * q) : 0;
}

static double wendland_c2_derivative(double r, double h)
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

/* Quintic spline: Morris 1996. */
static double quintic(double r, double h)
{
    return 27 / (120 * M_PI * h * h * h) * quintic_terms(r / h, 5);
}

static double quintic_derivative(double r, double h)
{
    return -27 * 15 / (120 * M_PI * h * h * h * h) * quintic_terms(r / h, 4);
}

const Kernel shape_kernels[] = {
    [KERNEL_CUBIC] = {"cubic", "cubic spline", cubic, cubic_derivative, 1},
    [KERNEL_WENDLAND_C2] = {"wendland_c2", "Wendland C2: no pairing, wants support 3", wendland_c2,
                            wendland_c2_derivative, 1},
    [KERNEL_QUINTIC] = {"quintic", "quintic spline: smoothest, wants support 3", quintic, quintic_derivative,
                        1},
    [SHAPE_KERNELS] = {0},
};

const Kernel density_kernels[] = {
    {"spiky", "the kernel of the pressure force too: energy is conserved", spiky, kernel_spiky_derivative, 1},
    {"poly6", "as in Müller 2003: pumps energy into the fluid, needs viscosity", kernel_poly6,
     poly6_derivative, 1},
    {"quintic", "quintic spline, of pressure too: a lattice hardly resists shear at support 3", quintic,
     quintic_derivative, 1.25},
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

static const double PI = 3.14159265358979323846;

enum { REACH = 4, SITES_MAX = (2 * REACH + 1) * (2 * REACH + 1) * (2 * REACH + 1) / 2, WAVES = 12 };

/* Half of the neighbours: opposite neighbours have the same part in a wave. */
typedef struct LatticeSites {
    int dimensions, count;
    double x[SITES_MAX][3];                   /* spacings */
    double dense[SITES_MAX], push[SITES_MAX]; /* parts of D and P per length, 1/m2 */
} LatticeSites;

static bool is_first_of_two(int i, int j, int k)
{
    return i > 0 || (i == 0 && (j > 0 || (j == 0 && k > 0)));
}

static void fill(LatticeSites *sites, const Lattice *lattice, double spacing, double h,
                 const Kernel *density_kernel, bool carried)
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
static double stiffness(const LatticeSites *sites, const double phase[3])
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
    LatticeSites sites;
    fill(&sites, lattice, spacing, support_radius, density_kernel, carried);
    return sqrt(fmax(0, stiffness(&sites, (double[3]){k[0] * spacing, k[1] * spacing, k[2] * spacing})));
}

/* Steps by `way` along the axes to better values until no step improves. */
static double climb(const LatticeSites *sites, double phase[3], double way, double greatest)
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
    LatticeSites sites;
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
