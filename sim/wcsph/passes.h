/* The passes of wcsph. */
#ifndef SLOSH_WCSPH_PASSES_H
#define SLOSH_WCSPH_PASSES_H

#include "sim/cpu/pass.h"
#include "sim/wcsph/columns.h"
#include "sim/wcsph/constants.h"

/* Equation of state, Tait's p = B ((rho / rho0)^7 - 1), Monaghan 1994, for e = rho / rho0 - 1: expanded in
   powers, to avoid cancellation. */
static inline float wcsph_state_of(const Constants *constants, int fluid, float e)
{
    return wcsph_constants(constants)->wcsph_fluids[fluid].tait * e *
           (7 + e * (21 + e * (35 + e * (35 + e * (21 + e * (7 + e))))));
}

/* e = rho / rho0 - 1 after a change by x, its rate times a time. Below half of the rest density, e is a
   different function of the sum s of changes, 1 + e = -1 / (4 s), which continues 1 + s smoothly: density
   in spray never reaches 0, and returns the same way. */
static inline float wcsph_density_after(float e, float x)
{
    const float before = 1 + e, sum = (e >= -0.5F ? e : -0.25F / before) + x;
    if (sum >= -0.5F)
        return sum;
    return e >= -0.5F ? -0.25F / sum - 1
                      : before / (1 - 4 * x * before) - 1; /* the same formula; for x = 0 exactly e */
}

/* Operations of `shape` in sim/wcsph/pair_kernel.h, counted as in sim/world/micro.h. */
static inline int wcsph_shape_flops(const Constants *constants)
{
    static const int flops[] = {[KERNEL_CUBIC] = 6, [KERNEL_WENDLAND_C2] = 4, [KERNEL_QUINTIC] = 15};
    return flops[wcsph_constants(constants)->kernel_shape];
}

/* Volume and pressure from the carried density; data of each particle for pair sums. */
extern const Pass wcsph_state;

/* The gradient of density for diffusion. */
extern const Pass wcsph_gradient;

/* Corrections of the gradients at the present positions. */
extern const Pass wcsph_correct;

/* Density += dt times its rate by the equation of continuity; then volume and pressure. */
extern const Pass wcsph_continuity;

/* Before wcsph_surface: each particle is a body of its own. */
extern const Pass wcsph_drops;

/* Normals of the surfaces, for surface tension by curvature; then the bodies of connected fluid. */
extern const Pass wcsph_surface;
void wcsph_join_few(const CpuRange *range);
void wcsph_join(const CpuRange *range);

/* After wcsph_forces: takes the mean force of surface tension by curvature off each body. */
extern const Pass wcsph_balance;

/* Accelerations by pressure, viscosity, walls and solids; sums for shifting. */
extern const Pass wcsph_forces;

/* Velocity changes for shifts. */
extern const Pass wcsph_carry;

/* Moves particles down the gradient of their number density at the last grid, at a velocity of chi c h / 2
   times the gradient over n0: Lind 2012. */
extern const Pass wcsph_shift;

#endif
