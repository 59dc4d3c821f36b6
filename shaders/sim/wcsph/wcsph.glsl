// Shared code of the passes of wcsph: sim/methods/wcsph/pairs_wcsph.c, sim/methods/wcsph/wcsph_passes.c.
#include "shaders/sim/wcsph/wcsph_block.h"
#include "sim/shapes.glsl"
#include "sim/images.glsl"

// Kernel slope over q for an image at distance r; below a spacing, the slope at a spacing.
float image_shape(float r)
{
    float q = max(r * inverse_support, 1e-6), wide = max(q, spacing * inverse_support);
    return shape(wide) * (wide / q);
}

// Pressure between fluids of different density, sim/methods/wcsph/pairs_surface.c. contrast: w of two rest densities, 0 for
// solids. BOTH_PRESS: pressure of a pair from the p V^2 of both.
#ifdef LAYERS
float contrast(float mine, float theirs)
{
    if (min(mine, theirs) <= 0.0)
        return 0.0;
    float w = max(1.0 - CONTRAST_LEAST * min(mine, theirs) / max(mine, theirs), 0.0);
    return mine < theirs ? w : -w;
}
#define BOTH_PRESS(own, other, w) ((own) + (other) + (w) * ((own) - (other)))
#else
#define contrast(mine, theirs) 0.0
#define BOTH_PRESS(own, other, w) ((own) + (other))
#endif

// e = rho / rho0 - 1 after a change by x: wcsph_density_after of sim/methods/wcsph/wcsph.h.
float density_after(float e, float x)
{
    float before = 1.0 + e, sum = (e >= -0.5 ? e : -0.25 / before) + x;
    if (sum >= -0.5)
        return sum;
    return e >= -0.5 ? -0.25 / sum - 1.0 : before / (1.0 - 4.0 * x * before) - 1.0;
}

// The boundary part of compression after dt at its rate: wcsph_boundary_part_after in sim/methods/wcsph/wcsph_private.h.
float boundary_part_after(float part, float rate, float dt)
{
    float lost = 0.5 * dt * boundary_fades;
    return ((1.0 - lost) * part + dt * rate) / (1.0 + lost);
}

struct State {
    float volume;
    vec2 pressure; // p, p V^2
};

// V = V0 rho0 / rho, for e = rho / rho0 - 1.
float volume_at(float e) { return 1.0 / ((1.0 + e) * rest_number_density); }

// Tait's p = B ((rho / rho0)^7 - 1), Monaghan 1994, for e = rho / rho0 - 1, expanded in powers.
// For pressure e has its boundary part more.
State state_of(float e, float more, uint fluid)
{
    float b = wcsph_fluids[fluid].tait, x = e + more;
    float p = b * x * (7.0 + x * (21.0 + x * (35.0 + x * (35.0 + x * (21.0 + x * (7.0 + x))))));
#ifndef NEGATIVE_PRESSURE
    p = p > 0.0 ? p : 0.0;
#endif
    float volume = volume_at(e);
    return State(volume, vec2(p, p * volume * volume));
}
