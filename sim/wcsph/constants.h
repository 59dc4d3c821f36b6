/* Constants of wcsph alone, and its terms. */
#ifndef SLOSH_WCSPH_CONSTANTS_H
#define SLOSH_WCSPH_CONSTANTS_H

#include "shaders/sim/wcsph/wcsph_block.h"
#include "sim/world/constants.h"

/* Number of times that sound needs to cross a support radius: the time in which carried density relaxes to
   the density of positions. Carried density ignores shifts and would drift by a percent per second. */
#define SHIFT_RETURN 20.0F

/* The same for diffusion without shifts, with slower drift: minutes of a shaken tank cost 3 % of its
   volume. */
#define DIFFUSION_RETURN 400.0F

/* The same with corrected gradients, which follow the flow's own divergence: noise of the sum would brake
   the flow. */
#define SHIFT_RETURN_CORRECTED 80.0F

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

#endif
