/* Symmetric matrices of a group of particles. For files compiled for each instruction set. */
#ifndef SLOSH_PAIR_MATRIX_H
#define SLOSH_PAIR_MATRIX_H

#include "sim/cpu/pair_loop.h"

typedef struct Symmetric {
    f8 xx, yy, zz, xy, yz, zx;
} Symmetric;

/* m^-1 b; 0 where det (3 m / trace) is below a quarter, since neighbours hardly span the space there.
   Inside the fluid det is 1, in a corner of the lattice 0.77. */
static __attribute__((unused)) Place renormalise(const Symmetric m, const Place b)
{
    const f8 cxx = m.yy * m.zz - m.yz * m.yz, cyy = m.xx * m.zz - m.zx * m.zx,
             czz = m.xx * m.yy - m.xy * m.xy;
    const f8 cxy = m.yz * m.zx - m.xy * m.zz, cyz = m.xy * m.zx - m.yz * m.xx,
             czx = m.xy * m.yz - m.zx * m.yy;
    const f8 det = m.xx * cxx + m.xy * cxy + m.zx * czx, mean = (m.xx + m.yy + m.zz) / f8_splat(3);
    const f8 scale = f8_masked(det > f8_splat(0.25f) * (mean * mean * mean), f8_splat(1) / det);
    return (Place){scale * (cxx * b.x + cxy * b.y + czx * b.z), scale * (cxy * b.x + cyy * b.y + cyz * b.z),
                   scale * (czx * b.x + cyz * b.y + czz * b.z)};
}

#endif
