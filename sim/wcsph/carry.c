/* Velocity correction for shifts. A shift is not part of the flow, so a shifted particle takes on the
   flow's velocity at its new position, v += (shift . grad) v; otherwise each shift mixes velocities like
   friction. After: P. N. Sun, A. Colagrossi, S. Marrone, M. Antuono, A. M. Zhang, "A consistent approach to
   particle shifting in the delta-Plus-SPH model", 2019; M. Antuono, P. N. Sun, S. Marrone, A. Colagrossi,
   "The delta-ALE-SPH model", 2021; with constant masses. */
#include "sim/wcsph/passes.h"

PAIR_LOOPS(wcsph_carried);

static void carry_body(const CpuRange *range)
{
    cpu_pairs(range, &wcsph_carried);
}

/* Per neighbour: {x, p V^2}, {v, V} and kind. */
static PairCost carry_pair(const Constants *constants)
{
    return (PairCost){.gather = 16 + 16 + 4, .flops = 48 + wcsph_shape_flops(constants)};
}

static const CpuPass carry = {.loops = {{carry_body, .walks = true}}, .pair = carry_pair};

const Pass wcsph_carry = {
    .name = "carry",
    .stage = STAGE_FORCE,
    .cpu = &carry,
    .shader = "wcsph/carry",
    .reads = "position velocity fluid kind uneven",
    .writes = "carried",
    .needed = wcsph_carries,
};
