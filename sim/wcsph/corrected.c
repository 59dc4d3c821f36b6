/* Corrected gradients (solver.corrected_gradient): sums of wcsph that are exact for linear fields, for any
   arrangement of particles. After: J. Bonet, T.-S. L. Lok, "Variational and momentum preservation aspects
   of Smooth Particle Hydrodynamic formulations", 1999. The divergence of velocity uses the particle's own
   correction, and pressure uses both corrections of a pair. So both operators are adjoint: energy and
   momentum are conserved, angular momentum is not. */
#include "sim/wcsph/passes.h"

#include <math.h>

PAIR_LOOPS(wcsph_matrix);

typedef struct Matrix {
    float xx, yy, zz, xy, yz, zx;
} Matrix;

static float ramp(float x, float from, float to)
{
    return fminf(fmaxf((x - from) / (to - from), 0), 1);
}

/* C = (M^-1 - 1) times a share. The share is 0 in spray, where less than 0.4 of the surrounding space is
   full, and 1 from 0.6 on, as at a flat surface. It is also 0 where neighbours hardly span the space. */
static Matrix correction(const Matrix m, int dimensions)
{
    const float cxx = m.yy * m.zz - m.yz * m.yz, cyy = m.xx * m.zz - m.zx * m.zx,
                czz = m.xx * m.yy - m.xy * m.xy;
    const float cxy = m.yz * m.zx - m.xy * m.zz, cyz = m.xy * m.zx - m.yz * m.xx,
                czx = m.xy * m.yz - m.zx * m.yy;
    const float det = m.xx * cxx + m.xy * cxy + m.zx * czx, mean = (m.xx + m.yy + m.zz) / 3;
    const float share = ramp(mean, 0.4f, 0.6f) * ramp(det / (mean * mean * mean), 0.5f, 0.75f);
    if (!(share > 0))
        return (Matrix){0};
    const float s = share / det, plane = dimensions == 2 ? 0 : 1;
    return (Matrix){s * cxx - share, s * cyy - share, plane * (s * czz - share), s * cxy, s * cyz, s * czx};
}

static void correct_body(const CpuRange *range)
{
    const CpuParticles *p = &range->cpu->now;
    const int dimensions = range->cpu->constants->dimensions;
    const float n0 = range->cpu->constants->rest_number_density;
    float *const *c = p->own + CORRECTION;
    cpu_pairs(range, &wcsph_matrix);
    for (size_t i = range->begin; i < range->end; i++) {
        const float v = p->volume[i] * n0;
        Matrix m = {v * c[0][i], v * c[1][i], v * c[2][i], v * c[3][i], v * c[4][i], v * c[5][i]};
        if (dimensions == 2)
            m.zz = 0.5f * (m.xx + m.yy);
        m = correction(m, dimensions);
        c[0][i] = m.xx, c[1][i] = m.yy, c[2][i] = m.zz, c[3][i] = m.xy, c[4][i] = m.yz, c[5][i] = m.zx;
    }
}

/* Per neighbour: {x, p V^2}. */
static PairCost correct_pair(const Constants *constants)
{
    return (PairCost){.gather = 16, .flops = 23 + wcsph_shape_flops(constants)};
}

static const CpuPass correct = {.loops = {{correct_body, .walks = true}}, .pair = correct_pair};

const Pass wcsph_correct = {
    .name = "correct",
    .stage = STAGE_DENSITY,
    .cpu = &correct,
    .shader = "wcsph/correct",
    .reads = "position fluid kind volume",
    .writes = "correction correction_mixed",
    .needed = wcsph_corrects,
};
