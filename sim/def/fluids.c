#include "sim/def/fluids.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

const TensionKind tension_kinds[] = {
    [TENSION_NONE] = {"none", "no surface tension"},
    [TENSION_COLOUR_FIELD] = {"colour_field",
                              "Müller 2003: curvature of the colour field; keeps no momentum"},
    [TENSION_COHESION] = {"cohesion", "Akinci 2013: particles of a fluid attract each other; keeps momentum"},
    [TENSION_CURVATURE] = {"curvature",
                           "Morris 2000 at a free surface: curvature from normals, contact angles "
                           "at walls; keeps the momentum of each body"},
    [TENSION_CURVATURE + 1] = {0},
};

double cohesion_kernel(double r, double h)
{
    const double both = (h - r) * r, cube = both * both * both, h2 = h * h;
    if (r >= h)
        return 0;
    return 2 * r > h ? cube : 2 * cube - h2 * h2 * h2 / 64;
}

/* Integral of the kernel from r to h: the work to part a pair. */
static double work(double r, double h)
{
    enum { STEPS = 200 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++)
        sum += cohesion_kernel(r + (i + 0.5) * (h - r) / STEPS, h);
    return r < h ? sum * (h - r) / STEPS : 0;
}

double cohesion_scale(int dimensions, double spacing, double h)
{
    const int reach = (int)ceil(h / spacing), deep = dimensions == 3 ? reach : 0;
    const double volume = pow(spacing, dimensions), area = volume / spacing;
    double sum = 0; /* a pair n layers apart crosses n planes */
    for (int n = 1; n <= reach; n++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -deep; k <= deep; k++)
                sum += n * work(spacing * sqrt((double)(n * n + j * j + k * k)), h);
    return sum > 0 ? 2 * area / (volume * volume * sum) : 0;
}

double cohesion_pressure(const WorldDef *def, int fluid)
{
    return 5 * def->fluids[fluid].surface_tension / def->spacing;
}

double colour_scale(int dimensions, double h)
{
    return dimensions == 3 ? 945 / (32 * M_PI * pow(h, 9)) : 24 / (M_PI * pow(h, 8));
}

/* x t^2 (3 - 2 t), t from 0 at x = 0.1 to 1 at 0.4: disorder within the fluid is no surface. */
static double curvature_weight(double x)
{
    const double least = CURVATURE_LEAST / 100.0, whole = CURVATURE_WHOLE / 100.0;
    const double t = fmin(fmax((x - least) / (whole - least), 0), 1);
    return x * t * t * (3 - 2 * t);
}

/* Sums over the lattice below layer k, or over the whole lattice, with w = (1 - r/h)^3. */
typedef struct LayerSums {
    double normal, along, height, heights; /* sum w z, w t^2, W |z|, W */
} LayerSums;

static LayerSums layer_sums(int dimensions, double spacing, double h, int above)
{
    const int reach = (int)ceil(h / spacing), deep = dimensions == 3 ? reach : 0;
    LayerSums sums = {0};
    for (int z = -above; z <= reach; z++)
        for (int a = -reach; a <= reach; a++)
            for (int b = -deep; b <= deep; b++) {
                const double q = spacing * sqrt((double)(z * z + a * a + b * b)) / h, t = fmax(1 - q, 0);
                const double w = t * t * t, wendland = w * t * (1 + 4 * q);
                sums.normal += w * z * spacing;
                sums.along += z >= 0 && z <= 1 ? w * (a * a + b * b) * spacing * spacing : 0;
                sums.height += wendland * abs(z) * spacing;
                sums.heights += wendland;
            }
    return sums;
}

double wetting_curvature(double angle, double spacing, double h)
{
    double layers = 0;
    for (int k = 0; (k + 0.5) * spacing < h; k++)
        layers += pow(1 - (k + 0.5) * spacing / h, 2);
    return cos(angle * (M_PI / 180)) / (layers * spacing);
}

/* Crowd at the surface of drops with shifting, over the lattice's: measured at 10 to 30 spacings a radius. */
#define CROWDED 1.12

/* The offset a second way: by the balance of half a drop, kept by pair forces whatever the pressures are.
   Layers z below the surface of a drop of radius R have the part D of the weights and the curvature (d - 1) /
   (R - z). Let V be the ball of one dimension less, and c = sum D z. The layers pull the halves together by
       sum D sigma (d - 1) V (R - z)^(d-2) = sigma (d - 1) V R^(d-2) (1 - (d - 2) c / R),
   with L the width missing at the rim of the cut. Pressure parts the halves by p V (R - L)^(d-1), so
       p = sigma (d - 1) / R (1 + ((d - 1) L - (d - 2) c) / R).
   Missing are pairs with one end outside. With F = -W' / r such pairs carry F x^2 across the cut, so
       e = sum F x^2 |z| / (2 sum F x^2) = sum W |z| / (2 sum W)
   after integration by parts along x. Where pressure sets in like the force, L = c + e, and p is too high by
   the part
       (c + (d - 1) e) / R = (d - 1) offset / R,
   as computed below. If pressure were the same up to the outermost layer, L would be e alone. */
CurvatureScale curvature_calibrate(int dimensions, double spacing, double h)
{
    const int reach = (int)ceil(h / spacing);
    const LayerSums top = layer_sums(dimensions, spacing, h, 0),
                    all = layer_sums(dimensions, spacing, h, reach);
    double layers = 0, depth = 0;
    for (int k = 0; k < reach; k++) {
        const double weight = curvature_weight(layer_sums(dimensions, spacing, h, k).normal / top.normal);
        layers += weight;
        depth += weight * (k + 0.5) * spacing;
    }
    return (CurvatureScale){
        .full = (float)(1 / top.normal),
        .layers = (float)layers,
        .few = (float)(0.05 * top.along),
        .crowd = (float)(1 / (CROWDED * top.along)),
        .offset = (float)(depth / layers / (dimensions - 1) + 0.5 * all.height / all.heights),
        .most = (float)(0.5 * (dimensions - 1) / spacing),
    };
}

const ViscosityKind viscosity_kinds[] = {
    [VISCOSITY_MORRIS] = {"morris",
                          "Morris 1997: along the difference of velocities; for flows without a surface"},
    [VISCOSITY_RADIAL] = {"radial",
                          "after Monaghan and Gingold 1983: along the line between two particles; right at "
                          "free surfaces, keeps angular momentum, half the step"},
    [VISCOSITY_RADIAL + 1] = {0},
};

const ViscosityKind viscosity_solvers[] = {
    [VISCOSITY_EXPLICIT] = {"explicit", "by the velocities at the begin of a step, which it bounds"},
    [VISCOSITY_IMPLICIT] = {"implicit",
                            "by those at its end, in the radial form: a solver that iterates, and "
                            "no bound on the step; for thick fluid"},
    [VISCOSITY_IMPLICIT + 1] = {0},
};

double pair_viscosity(double a, double b)
{
    return a + b > 0 ? 4 * a * b / (a + b) : 0;
}

enum { REACH = 4, SITES = (2 * REACH + 1) * (2 * REACH + 1) * (2 * REACH + 1), WAVES = 8 };

/* Half of the neighbours: a site and its mirror image weigh the same. */
typedef struct SurfaceSites {
    int count;
    double x[SITES][3]; /* spacings */
    double weight[SITES];
    bool along; /* friction acts along x alone */
} SurfaceSites;

/* w(r): a pair's force is V_i V_j mu w v_ji, or V_i V_j mu w (v_ji . x) x for friction along the line. */
static double friction_weight(const Lattice *lattice, Friction friction, double r, double h)
{
    if (friction == FRICTION_LAPLACIAN)
        return lattice->laplacian_scale * kernel_viscosity_laplacian(r, h);
    const double morris = -2 * lattice->gradient_scale * lattice->pressure_kernel->derivative(r, h) / r;
    return friction == FRICTION_RADIAL       ? morris * lattice->radial_scale
           : friction == FRICTION_ARTIFICIAL ? morris / (r * r + h * h / 400)
                                             : morris;
}

/* Sites along the lattice's first `axes` axes: a thread, a film, or the whole lattice. Returns the density of
   the sites over that of the lattice at rest. */
static double sites_fill(SurfaceSites *sites, const Lattice *lattice, double spacing, Friction friction,
                         int axes, double h, const Kernel *summed)
{
    const int deep[3] = {REACH, axes > 1 ? REACH : 0, axes > 2 ? REACH : 0};
    double sum = summed ? summed->value(0, h) : 0;
    *sites = (SurfaceSites){.along = friction == FRICTION_RADIAL || friction == FRICTION_ARTIFICIAL};
    for (int i = -deep[0]; i <= deep[0]; i++)
        for (int j = -deep[1]; j <= deep[1]; j++)
            for (int k = -deep[2]; k <= deep[2]; k++) {
                const double r = spacing * sqrt((double)(i * i + j * j + k * k));
                if (r == 0 || r >= h)
                    continue;
                sum += summed ? summed->value(r, h) : 0;
                if (i < 0 || (i == 0 && (j < 0 || (j == 0 && k < 0))))
                    continue;
                sites->weight[sites->count] =
                    2 * friction_weight(lattice, friction, r, h) * (sites->along ? spacing * spacing : 1);
                memcpy(sites->x[sites->count++], (double[3]){i, j, k}, sizeof sites->x[0]);
            }
    return summed ? sum * lattice->density_scale / lattice->number_density : 1;
}

/* Greatest eigenvalue of a symmetric positive semidefinite matrix. */
static double greatest_eigenvalue(double m[3][3])
{
    double v[3] = {1, 0.7, 0.4}, length = 0;
    for (int step = 0; step < 40; step++) {
        double next[3];
        length = 0;
        for (int a = 0; a < 3; a++) {
            next[a] = m[a][0] * v[0] + m[a][1] * v[1] + m[a][2] * v[2];
            length += next[a] * next[a];
        }
        length = sqrt(length);
        for (int a = 0; a < 3 && length > 0; a++)
            v[a] = next[a] / length;
    }
    return length;
}

/* cos(pi n / WAVES) from constants: the last bit of the C library's cosine depends on the processor, and so
   would a step. */
static double wave_cosine(int n)
{
    static const double quarter[] = {1, 0.92387953251128674, 0.70710678118654752, 0.38268343236508977, 0};
    const int turn = abs(n) % (2 * WAVES), half = turn > WAVES ? 2 * WAVES - turn : turn;
    return half <= WAVES / 2 ? quarter[half] : -quarter[WAVES - half];
}

/* Rate of a wave whose phase advances by `phase` pi / WAVES per site along each axis. */
static double rate_of_wave(const SurfaceSites *sites, const int phase[3])
{
    double sum = 0, m[3][3] = {{0}};
    for (int n = 0; n < sites->count; n++) {
        const double *x = sites->x[n];
        const double part =
            sites->weight[n] *
            (1 - wave_cosine(phase[0] * (int)x[0] + phase[1] * (int)x[1] + phase[2] * (int)x[2]));
        sum += part;
        for (int a = 0; a < 3 && sites->along; a++)
            for (int b = 0; b < 3; b++)
                m[a][b] += part * x[a] * x[b];
    }
    return sites->along ? greatest_eigenvalue(m) : sum;
}

static double greatest_rate(const SurfaceSites *sites, int axes)
{
    double greatest = 0;
    for (int i = 0; i <= WAVES; i++)
        for (int j = 0; j <= (axes > 1 ? i : 0); j++)
            for (int k = 0; k <= (axes > 2 ? j : 0); k++)
                greatest = fmax(greatest, rate_of_wave(sites, (int[3]){i, j, k}));
    return greatest;
}

double friction_rate(const Lattice *lattice, double spacing, Friction friction, double support_radius,
                     const Kernel *summed)
{
    double greatest = 0;
    for (int axes = summed ? 1 : lattice->dimensions; axes <= lattice->dimensions; axes++) {
        SurfaceSites sites;
        const double density = sites_fill(&sites, lattice, spacing, friction, axes, support_radius, summed);
        greatest =
            fmax(greatest, greatest_rate(&sites, axes) / (lattice->number_density * density * density));
    }
    return greatest;
}
