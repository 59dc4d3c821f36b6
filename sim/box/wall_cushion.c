#include "sim/box/wall_cushion.h"

void walls_cushion(const Walls *walls, float dt, const float g[3], const float x[3], const float v[3],
                   float a[3])
{
    const float reach = CUSHION_REACH * walls->spacing, most = dt > 0 ? CUSHION_TURN / (dt * dt) : 0;
    for (int k = 0; k < walls->dimensions; k++) {
        const float low = x[k] + (k == 1 ? 0 : walls->half_size[k]), high = 2 * walls->half_size[k] - low;
        if (walls->open[k])
            continue;
        const float spring = fminf(CUSHION_PUSH / reach * fabsf(g[k]), most);
        const float leaves = CUSHION_LEAVES * sqrtf(fabsf(g[k]) * walls->spacing),
                    away = g[k] > 0 ? -v[k] : v[k],
                    share = leaves > 0 ? fminf(fmaxf(1 - away / leaves, 0), 1) : 0;
        a[k] += share * spring * (g[k] > 0 ? -fmaxf(reach - high, 0) : fmaxf(reach - low, 0));
    }
}
