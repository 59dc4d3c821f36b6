#include "sim/matter/tension.h"

#include <math.h>
#include <stdlib.h>

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

double curvature_weight(double x)
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
   (R - z). With V the ball of one dimension less, and c = sum D z, the layers pull the halves together by
       sum D sigma (d - 1) V (R - z)^(d-2) = sigma (d - 1) V R^(d-2) (1 - (d - 2) c / R),
   and pressure parts the halves by p V (R - L)^(d-1), L the width missing at the rim of the cut:
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
