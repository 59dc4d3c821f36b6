/* The equation of state of wcsph. */
#ifndef SLOSH_WCSPH_STATE_H
#define SLOSH_WCSPH_STATE_H

/* p = B ((rho / rho0)^7 - 1), Monaghan 1994, of e = rho / rho0 - 1: its powers, without the difference. */
static inline float wcsph_tait(float b, float e)
{
    return b * e * (7 + e * (21 + e * (35 + e * (35 + e * (21 + e * (7 + e))))));
}

#endif
