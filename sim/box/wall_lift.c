#include "sim/box/wall_lift.h"

double wall_lift_brute(const Lattice *lattice, double spacing, double support_radius, double d)
{
    const double h = support_radius;
    const int reach = (int)ceil(h / spacing), across = lattice->dimensions == 3 ? reach : 0;
    double sum = 0;
    for (int n = 0; n <= reach; n++)
        for (int i = -reach; i <= reach; i++)
            for (int j = -across; j <= across; j++) {
                const double y = (n + 0.5) * spacing, x = d + y;
                const double r = sqrt(x * x + (i * i + j * j) * spacing * spacing);
                if (r < h)
                    sum -= lattice->pressure_kernel->derivative(r, h) / r * x * 2 * y;
            }
    return lattice->gradient_scale * sum / lattice->number_density;
}

/* lift over lift at the wall. */
static float shape(float d, float h)
{
    const float t = fmaxf(1 - d / h, 0), t2 = t * t;
    return t2 * t2 * t * (3 - 2 * t);
}

WallLift wall_lift_of(const Lattice *lattice, double spacing, double support_radius)
{
    const double layer = 0.5 * spacing;
    const float h = (float)support_radius,
                held = (float)wall_lift_brute(lattice, spacing, support_radius, layer);
    return (WallLift){h, held / shape((float)layer, h)};
}

void walls_lift(const WallLift *lift, const Walls *walls, const float x[3], float out[3])
{
    for (int a = 0; a < 3; a++) {
        const float low = x[a] + (a == 1 ? 0 : walls->half_size[a]), high = 2 * walls->half_size[a] - low;
        const bool wall = a < walls->dimensions && !walls->open[a];
        out[a] = wall ? lift->scale * (shape(low, lift->reach) + shape(high, lift->reach)) : 0;
    }
}
