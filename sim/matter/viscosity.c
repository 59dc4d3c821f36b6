#include "sim/matter/viscosity.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

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
typedef struct Sites {
    int count;
    double x[SITES][3]; /* spacings */
    double weight[SITES];
    bool along; /* friction acts along x alone */
} Sites;

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
static double sites_fill(Sites *sites, const Lattice *lattice, double spacing, Friction friction, int axes,
                         double h, const Kernel *summed)
{
    const int deep[3] = {REACH, axes > 1 ? REACH : 0, axes > 2 ? REACH : 0};
    double sum = summed ? summed->value(0, h) : 0;
    *sites = (Sites){.along = friction == FRICTION_RADIAL || friction == FRICTION_ARTIFICIAL};
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
static double rate_of_wave(const Sites *sites, const int phase[3])
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

static double greatest_rate(const Sites *sites, int axes)
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
        Sites sites;
        const double density = sites_fill(&sites, lattice, spacing, friction, axes, support_radius, summed);
        greatest =
            fmax(greatest, greatest_rate(&sites, axes) / (lattice->number_density * density * density));
    }
    return greatest;
}
