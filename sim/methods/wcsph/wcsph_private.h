/* What the files of wcsph share: its constants, columns and passes. */
#ifndef SIM_METHODS_WCSPH_WCSPH_PRIVATE_H
#define SIM_METHODS_WCSPH_WCSPH_PRIVATE_H

#include "sim/methods/wcsph/wcsph.h"

#include "shaders/sim/wcsph/wcsph_block.h"
#include "sim/cpu/cpu.h"
#include "sim/state.h"
#include "sim/step/constants.h"
#include "sim/step/method.h"

/* Constants of wcsph alone, and its terms. */

/* Number of times that sound needs to cross a support radius: the time in which carried density relaxes to
   the density of positions. Carried density ignores shifts and would drift by a percent per second. */
#define SHIFT_RETURN 20.0F

/* The same for diffusion without shifts, with slower drift: minutes of a shaken tank cost 3 % of its
   volume. */
#define DIFFUSION_RETURN 400.0F

/* The same with corrected gradients, which follow the flow's own divergence: noise of the sum would brake
   the flow. */
#define SHIFT_RETURN_CORRECTED 80.0F

/* The same for the second part of boundary particles in the rate. A boundary particle pushes with p_i + p_b:
   twice what its part of the rate stores. Where density diffuses, the stored part comes late, and a tank
   above a plate hums for ever. So boundary particles count twice for fast flow, as images of the fluid in
   walls do. The second part fades: the sum of W has none. 2 to 20 times end the hum. */
#define BOUNDARY_FADES 10.0F

static inline const WcsphBlock *wcsph_constants(const Constants *constants)
{
    return (const WcsphBlock *)(const void *)constants->of_method;
}

bool wcsph_diffuses(const Constants *constants);
bool wcsph_corrects(const Constants *constants);
bool wcsph_returns(const Constants *constants); /* carried density relaxes to the sum of W */
bool wcsph_carries(const Constants *constants);
bool wcsph_curves(const Constants *constants);
bool wcsph_layers(const Constants *constants); /* densities of two fluids differ by more than a factor
                                                  CONTRAST_LEAST */
bool wcsph_is_artificial(const Constants *constants);
bool wcsph_meets_solids(const Constants *constants); /* next to solids */

/* Columns of wcsph alone: indices in ParticleColumns.own. */

enum {
    ARTIFICIAL, /* viscosity of the particle's fluid, Pa s */
    RELATIVE,   /* copy of the compression for diffusion: the pass of continuity changes the neighbours'
                   column meanwhile */
    SLOPE,      /* gradient of RELATIVE, 1/m */
    UNEVEN = SLOPE + 3,         /* direction of shifting: sum of F x_ij, 1/m; with corrected gradients plus
                                   the sum of (S_i + S_j) / 2 F x_ij, sim/methods/wcsph/pairs_corrected.c */
    FULL = UNEVEN + 3,          /* sum of F r^2; then 0 to 1, rising with the distance from a surface */
    DENSE,                      /* sum of W; then n / n0 - 1 */
    OUTWARD,                    /* normal of a surface, times the particle's weight in the surface */
    RATE = OUTWARD + 3,         /* rate of the compression, 1/s, at the end of the last step */
    CORRECTION,                 /* C of sim/methods/wcsph/wcsph_passes.c: xx, yy, zz, and xy, yz, zx */
    CARRIED = CORRECTION + 6,   /* (uneven . grad) v of sim/methods/wcsph/wcsph_passes.c, 1/(m s) */
    REST_DENSITY = CARRIED + 3, /* of the particle's fluid, kg/m3 */
    PULL = REST_DENSITY + 1,    /* force of surface tension by curvature, as ParticleColumns.ax */
    DROP = PULL + 3,     /* sim/methods/wcsph/drops.c, in integers: way to the root of the particle's body; */
    DROP_SUM = DROP + 1, /* of roots: sum of PULL over the body; */
    DROP_TALLY = DROP_SUM + 3,         /* of roots: number of particles, and axes with a wall */
    BOUNDARY_PART = DROP_TALLY + 1,    /* compression by boundary particles that fades; */
    BOUNDARY_RATE = BOUNDARY_PART + 1, /* its rate, 1/s, at the end of the last step: their part of RATE */
};
_Static_assert((int)BOUNDARY_RATE < (int)COLUMNS_KEPT, "columns of terms follow");

extern const ColumnDef wcsph_columns[];

/* The passes of wcsph. */

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

/* The boundary part of compression after dt (s) at its rate: BOUNDARY_FADES; by the middle rule, as
   accurate as the step. */
static inline float wcsph_boundary_part_after(const WcsphBlock *own, float part, float rate, float dt)
{
    const float lost = 0.5F * dt * own->boundary_fades;
    return ((1 - lost) * part + dt * rate) / (1 + lost);
}

/* Operations of `shape` in sim/methods/wcsph/pair_wcsph.h, counted as in sim/step/method.h. */
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
