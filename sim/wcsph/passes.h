/* The passes of wcsph. */
#ifndef SLOSH_WCSPH_PASSES_H
#define SLOSH_WCSPH_PASSES_H

#include "sim/cpu/pass.h"
#include "sim/wcsph/columns.h"
#include "sim/wcsph/constants.h"

/* The equation of state, Tait's p = B ((rho / rho0)^7 - 1), Monaghan 1994, of e = rho / rho0 - 1: its powers,
   without the difference. */
static inline float wcsph_state_of(const Constants *constants, int fluid, float e)
{
    return wcsph_constants(constants)->wcsph_fluids[fluid].tait * e *
           (7 + e * (21 + e * (35 + e * (35 + e * (21 + e * (7 + e))))));
}

/* e = rho / rho0 - 1 after a change by x, its rate times a time. Below half of the rest density e goes by
   another function of the sum s of changes, 1 + e = -1 / (4 s), which joins 1 + s smoothly: what flies apart
   never comes to a density of 0, and comes back the same way. */
static inline float wcsph_density_after(float e, float x)
{
    const float before = 1 + e, sum = (e >= -0.5F ? e : -0.25F / before) + x;
    if (sum >= -0.5F)
        return sum;
    return e >= -0.5F ? -0.25F / sum - 1
                      : before / (1 - 4 * x * before) - 1; /* the same; e to the bit for x = 0 */
}

/* Operations of `shape` in sim/wcsph/pair_kernel.h, counted as sim/world/micro.h says. */
static inline int wcsph_shape_flops(const Constants *constants)
{
    static const int flops[] = {[KERNEL_CUBIC] = 6, [KERNEL_WENDLAND_C2] = 4, [KERNEL_QUINTIC] = 15};
    return flops[wcsph_constants(constants)->kernel_shape];
}

/* Volume and pressure, by the density that particles carry; what pair sums need of each. */
extern const Pass wcsph_state;

/* The same, and the gradient of density, of which diffusion has need. */
extern const Pass wcsph_gradient;

/* Corrections of the gradients, as particles stand now. */
extern const Pass wcsph_correct;

/* Density += dt times its rate by the equation of continuity; volume and pressure after it. */
extern const Pass wcsph_continuity;

/* Where there is surface tension by curvature: normals of the surfaces. */
extern const Pass wcsph_surface;

/* Accelerations by pressure, viscosity, walls and solids; what shifting goes by. */
extern const Pass wcsph_forces;

/* What velocity changes by over such a shift. */
extern const Pass wcsph_carry;

/* Moves particles down the gradient of their number density as it was at the last grid, by a velocity of chi
   c h / 2 times that over n0: Lind 2012. */
extern const Pass wcsph_shift;

#endif
