/* What a def means in numbers for wcsph alone, and which terms it names. */
#ifndef SLOSH_WCSPH_CONSTANTS_H
#define SLOSH_WCSPH_CONSTANTS_H

#include "shaders/sim/wcsph/wcsph_block.h"
#include "sim/world/constants.h"

/* Times in which sound crosses a support radius: after so many the density that shifted particles carry,
   which does not know of shifts and would drift by a percent a second, comes back to that of their places. */
#define SHIFT_RETURN 20.0F

/* The same of diffusion without shifts, whose drift is slower: minutes of a shaken tank cost it 3 % of its
 * volume. */
#define DIFFUSION_RETURN 400.0F

/* The same with corrected gradients, which keep to the flow's own divergence: the sum's noise brakes. */
#define SHIFT_RETURN_CORRECTED 80.0F

static inline const WcsphBlock *wcsph_constants(const Constants *constants)
{
    return (const WcsphBlock *)(const void *)constants->of_method;
}

bool wcsph_diffuses(const Constants *constants);
bool wcsph_corrects(const Constants *constants);
bool wcsph_returns(const Constants *constants); /* carried density comes back to the sum of W */
bool wcsph_carries(const Constants *constants);
bool wcsph_curves(const Constants *constants);
bool wcsph_layers(const Constants *constants); /* two fluids differ by more than CONTRAST_LEAST */
bool wcsph_is_artificial(const Constants *constants);

#endif
