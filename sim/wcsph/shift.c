/* Shifting of particles down the gradient of their number density, to prevent particles from lining up.
   After: S. J. Lind, R. Xu, P. K. Stansby, B. D. Rogers, "Incompressible smoothed particle hydrodynamics
   for free-surface flows", 2012, eq. 22 to 25; P. N. Sun, A. Colagrossi, S. Marrone, A. M. Zhang, "The
   delta-plus-SPH model", 2017. */
#include "sim/wcsph/passes.h"

#include <math.h>

/* Shift of chi c (h / 2) dt V0 sum F x_ij, with corrected gradients sum (1 + (S_i + S_j) / 2) F x_ij of
   sim/wcsph/pairs_corrected.c, limited to a tenth of a spacing along each axis. */
static inline void shift_run(const CpuRange *range, const bool wide)
{
    const Constants *s = range->cpu->constants;
    const CpuParticles *p = &range->cpu->now;
    float *const x[3] = {p->x, p->y, p->z}, *const v[3] = {p->vx, p->vy, p->vz};
    const float dt = range->input->dt;
    const float most = 0.1f * s->spacing,
                scale = wcsph_constants(s)->shift_speed * dt / s->rest_number_density;
    const float part = fminf(dt * wcsph_constants(s)->density_return, 1);
    for (size_t i = range->begin; i < range->end; i++) {
        float longest = 0;
        for (int k = 0; k < 3; k++)
            longest = fmaxf(longest, fabsf(scale * p->own[UNEVEN + k][i]));
        const float times = longest > most ? scale * (most / longest) : scale;
        for (int k = 0; k < 3; k++)
            place_move(&x[k][i], wide ? &p->own[COLUMNS_LEFT + k][i] : NULL, times * p->own[UNEVEN + k][i]);
        for (int k = 0; p->own[CARRIED] && k < 3; k++)
            v[k][i] += times * p->own[CARRIED + k][i];
        p->compression[i] += part * p->own[FULL][i] * (p->own[DENSE][i] - p->compression[i]);
    }
}

static void shift_body(const CpuRange *range)
{
    if (range->cpu->constants->wide)
        shift_run(range, true);
    else
        shift_run(range, false);
}

static const CpuPass shift = {.loops = {{shift_body}}};

const Pass wcsph_shift = {
    .name = "shift",
    .stage = STAGE_FORCE,
    .cpu = &shift,
    .shader = "wcsph/shift",
    .reads = "position remainder velocity compression uneven full dense carried",
    .writes = "position remainder velocity compression",
    .needed = wcsph_returns,
};
