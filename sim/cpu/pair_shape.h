/* The kernels named by solver.kernel, in pair loops. For files compiled for each instruction set. */
#ifndef SLOSH_PAIR_SHAPE_H
#define SLOSH_PAIR_SHAPE_H

#include "sim/cpu/walk.h"
#include "sim/kernel/kernel.h"

/* Kernel slope f(q) = -w'(q) / q, up to a factor in the caller's scale; 0 from q = 1 on.

   w is 1 - 6 q^2 + 6 q^3 and 2 (1 - q)^3 for the cubic; (1 - q)^4 (1 + 4 q) for Wendland C2; for the
   quintic the powers of 3 - 3 q, 2 - 3 q, 1 - 3 q. */
SIMD_INLINE f8 shape(f8 q, const ShapeKernel kernel)
{
    const f8 one = f8_splat(1), zero = f8_splat(0), t = closeness(q);
    if (kernel == KERNEL_WENDLAND_C2)
        return f8_splat(20) * (t * t * t);
    if (kernel == KERNEL_CUBIC)
        return f8_select(q < f8_splat(0.5f), f8_splat(12) - f8_splat(18) * q, f8_splat(6) * (t * t) / q);
    const f8 a = f8_splat(3) * t, b = a - one, c = b - one;
    const f8 a2 = a * a, b2 = f8_masked(b > zero, b * b), c2 = f8_masked(c > zero, c * c);
    return (a2 * a2 - f8_splat(6) * (b2 * b2) + f8_splat(15) * (c2 * c2)) / q;
}

/* w(q) / w(0); 0 from q = 1 on. */
SIMD_INLINE f8 height(f8 q, const ShapeKernel kernel)
{
    const f8 one = f8_splat(1), zero = f8_splat(0), t = closeness(q), t2 = t * t;
    if (kernel == KERNEL_WENDLAND_C2)
        return t2 * t2 * (one + f8_splat(4) * q);
    if (kernel == KERNEL_CUBIC)
        return f8_select(q < f8_splat(0.5f), one - f8_splat(6) * (q * q * t), f8_splat(2) * (t2 * t));
    const f8 a = f8_splat(3) * t, b = a - one, c = b - one;
    const f8 a2 = a * a, b2 = f8_masked(b > zero, b * b), c2 = f8_masked(c > zero, c * c);
    return (a2 * a2 * a - f8_splat(6) * (b2 * b2 * b) + f8_splat(15) * (c2 * c2 * c)) / f8_splat(66);
}

#endif
