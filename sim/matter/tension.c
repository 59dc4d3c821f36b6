#include "sim/matter/tension.h"

#include <math.h>

const TensionKind tension_kinds[] = {
    [TENSION_NONE] = {"none", "no surface tension"},
    [TENSION_COLOUR_FIELD] = {"colour_field",
                              "Müller 2003: curvature of the colour field; keeps no momentum"},
    [TENSION_COHESION] = {"cohesion", "Akinci 2013: particles of a fluid attract each other; keeps momentum"},
    [TENSION_COHESION + 1] = {0},
};

double cohesion_kernel(double r, double h)
{
    const double both = (h - r) * r, cube = both * both * both, h2 = h * h;
    if (r >= h)
        return 0;
    return 2 * r > h ? cube : 2 * cube - h2 * h2 * h2 / 64;
}

/* The integral of the kernel from r to h: what it takes to part a pair. */
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

double colour_scale(int dimensions, double h)
{
    return dimensions == 3 ? 945 / (32 * M_PI * pow(h, 9)) : 24 / (M_PI * pow(h, 8));
}
