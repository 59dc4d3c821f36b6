#include "render/particles/particles.h"
#include "sim/kernel/kernel.h"
#include "sim/step/method.h"

#include <math.h>
#include <string.h>

static double cubic(double q)
{
    const double t = 1 - q;
    return q < 0.5 ? 1 - 6 * q * q * t : 2 * t * t * t;
}

static double wendland_c2(double q)
{
    const double t = (1 - q) * (1 - q);
    return t * t * (1 + 4 * q);
}

static double quintic(double q)
{
    const double a = 3 - 3 * q, b = fmax(2 - 3 * q, 0), c = fmax(1 - 3 * q, 0);
    return pow(a, 5) - 6 * pow(b, 5) + 15 * pow(c, 5);
}

static double poly6(double q)
{
    const double t = 1 - q * q;
    return t * t * t;
}

static double spiky(double q)
{
    return (1 - q) * (1 - q) * (1 - q);
}

static double cusp(double q)
{
    return (1 - q) * (1 - q);
}

/* Same order as in shaders/common/plane_kernel.glsl. The test integrates each kernel to 1. */
const PlaneKernel plane_kernels[] = {
    {.name = "solver", .help = "the method's own"},
    {"cubic", "cubic spline: Monaghan and Lattanzio 1985", cubic, {40 / (7 * M_PI), 8 / M_PI}},
    {"wendland_c2", "Wendland 1995", wendland_c2, {7 / M_PI, 21 / (2 * M_PI)}},
    {"quintic", "quintic spline: Morris 1996", quintic, {63 / (478 * M_PI), 27 / (120 * M_PI)}},
    {"poly6", "Müller 2003, eq. 20", poly6, {4 / M_PI, 315 / (64 * M_PI)}},
    {"spiky", "Müller 2003, eq. 21", spiky, {10 / M_PI, 15 / M_PI}},
    {"cusp", "(1 - r/h)^2", cusp, {6 / M_PI, 15 / (2 * M_PI)}},
    {0},
};

int plane_kernel_named(const char *name)
{
    for (int k = 1; plane_kernels[k].name; k++)
        if (strcmp(plane_kernels[k].name, name) == 0)
            return k;
    return 1;
}

int plane_kernel_of(int asked, const WorldDef *world)
{
    if (asked > 0)
        return asked;
    const Kernel *own = method_find(world->method) ? method_kernels(world).density : NULL;
    return own ? plane_kernel_named(own->name) : 1;
}

double plane_kernel_value(int kernel, int dimensions, double r, double h)
{
    const PlaneKernel *row = &plane_kernels[kernel];
    return r < h ? row->norm[dimensions - 2] * row->shape(r / h) / pow(h, dimensions) : 0;
}
