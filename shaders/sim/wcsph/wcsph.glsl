// What the passes of wcsph share: sim/wcsph/pairs.c, sim/wcsph/density.c.
#include "shaders/sim/wcsph/wcsph_block.h"

// f(q) = -w'(q) / q of the kernel, up to a factor that gradient_scale takes care of.
float shape(float q)
{
    float t = 1.0 - q;
#if defined KERNEL_WENDLAND_C2
    return 20.0 * (t * t * t);
#elif defined KERNEL_QUINTIC
    vec3 powers = max(vec3(3.0 * t, 3.0 * t - 1.0, 3.0 * t - 2.0), 0.0);
    powers *= powers;
    powers *= powers;
    return (powers.x - 6.0 * powers.y + 15.0 * powers.z) / q;
#else
    return q < 0.5 ? 12.0 - 18.0 * q : 6.0 * (t * t) / q;
#endif
}

#ifdef SHIFTING
// w(q) / w(0).
float height(float q)
{
    float t = 1.0 - q;
#if defined KERNEL_WENDLAND_C2
    return t * t * t * t * (1.0 + 4.0 * q);
#elif defined KERNEL_QUINTIC
    vec3 base = max(vec3(3.0 * t, 3.0 * t - 1.0, 3.0 * t - 2.0), 0.0), powers = base * base;
    powers *= powers * base;
    return (powers.x - 6.0 * powers.y + 15.0 * powers.z) / 66.0;
#else
    return q < 0.5 ? 1.0 - 6.0 * q * q * t : 2.0 * t * t * t;
#endif
}
#endif

struct State {
    float volume;
    vec2 pressure; // p, p V^2
};

// V = V0 rho0 / rho of e = rho / rho0 - 1.
float volume_at(float e) { return 1.0 / ((1.0 + e) * rest_number_density); }

// Tait's p = B ((rho / rho0)^7 - 1), Monaghan 1994, of e = rho / rho0 - 1, by its powers.
State state_of(float e, uint fluid)
{
    float b = wcsph_fluids[fluid].tait;
    float p = b * e * (7.0 + e * (21.0 + e * (35.0 + e * (35.0 + e * (21.0 + e * (7.0 + e))))));
#ifndef NEGATIVE_PRESSURE
    p = p > 0.0 ? p : 0.0;
#endif
    float volume = volume_at(e);
    return State(volume, vec2(p, p * volume * volume));
}
