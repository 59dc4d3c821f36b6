/* Kernels of wcsph in its pair loops. */
#ifndef SLOSH_PAIR_KERNEL_H
#define SLOSH_PAIR_KERNEL_H

#include "sim/cpu/pair_loop.h"
#include "sim/cpu/pair_shape.h"
#include "sim/wcsph/columns.h"
#include "sim/wcsph/constants.h"

/* `body(args, begin, end, kernel)` with the kernel as a constant, so that each kernel has a separate loop. */
#define FOR_KERNEL(args, begin, end, body)                                                                   \
    do {                                                                                                     \
        if (wcsph_constants((args)->constants)->kernel_shape == KERNEL_WENDLAND_C2)                          \
            body(args, begin, end, KERNEL_WENDLAND_C2);                                                      \
        else if (wcsph_constants((args)->constants)->kernel_shape == KERNEL_QUINTIC)                         \
            body(args, begin, end, KERNEL_QUINTIC);                                                          \
        else                                                                                                 \
            body(args, begin, end, KERNEL_CUBIC);                                                            \
    } while (0)

#endif
