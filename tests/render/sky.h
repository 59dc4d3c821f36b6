/* The sky of shaders/common/environment.glsl, for tests of mirrors. */
#ifndef SLOSH_TESTS_SKY_H
#define SLOSH_TESTS_SKY_H

#include "render/frame/frame.h"

#include <math.h>

static inline double sky_wave(double at)
{
    const double away = fabs(at - floor(at) - 0.5);
    return away * away * (12 - 16 * away);
}

static inline double sky_clouds(const double to[3])
{
    double product = 1;
    for (int k = 0; k < 2; k++) {
        const double low = 0.4 + fmax(to[1], 0), at = to[2 * k] / low, other = to[2 - 2 * k] / low;
        product *= sky_wave(0.9 * (at + 0.35 * sky_wave(1.3 * other + 0.2)));
    }
    return product * fmin(fmax(3 * to[1], 0), 1);
}

/* Linear light from a direction of the world, a unit vector; `component`: of red, green, blue. */
static inline double sky_light(const ViewDef *def, const double to[3], int component)
{
    static const double light[] = {-0.40, 0.84, 0.3666}, high[] = {0.75, 0.95, 1.20},
                        cloud[] = {0.75, 0.70, 0.62}, glow[] = {1.2, 1.0, 0.7};
    const double haze = 1 / (1 + 24 * to[1] * to[1]), above = to[1] > 0 ? high[component] : 1,
                 sun = fmax(to[0] * light[0] + to[1] * light[1] + to[2] * light[2], 0);
    return def->background[component] *
           (above + haze * (2.1 - above) + cloud[component] * sky_clouds(to) + glow[component] * pow(sun, 8));
}

#endif
