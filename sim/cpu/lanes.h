/* Loops over particles without neighbours, four at a time: the width of every processor. */
#ifndef SIM_CPU_LANES_H
#define SIM_CPU_LANES_H

#include "sim/box/box.h"

#include <string.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

enum { FOUR = 4 };

typedef float f4 __attribute__((vector_size(16)));
typedef int32_t i4 __attribute__((vector_size(16))); /* as a mask: -1 where true */
typedef uint32_t u4 __attribute__((vector_size(16)));

/* Particles i to i + 3; columns can be read past the last. */
static inline f4 f4_load(const float *column, size_t i)
{
    f4 value;
    memcpy(&value, column + i, sizeof value);
    return value;
}

static inline f4 f4_splat(float x)
{
    return (f4){x, x, x, x};
}

/* Lanes of a where the mask is set, of b elsewhere. */
static inline f4 f4_select(i4 mask, f4 a, f4 b)
{
    return (f4)(((i4)a & mask) | ((i4)b & ~mask));
}

/* Minimum and maximum; b if a or b is NaN. */
static inline f4 f4_lesser(f4 a, f4 b)
{
    return f4_select(a < b, a, b);
}

static inline f4 f4_greater(f4 a, f4 b)
{
    return f4_select(a > b, a, b);
}

/* A bit per lane. */
static inline unsigned i4_bits(i4 mask)
{
#if defined(__SSE2__)
    return (unsigned)_mm_movemask_ps((__m128)mask);
#else
    return (mask[0] & 1u) | (mask[1] & 2u) | (mask[2] & 4u) | (mask[3] & 8u);
#endif
}

/* Mask of particles i to i + 3 before `end`. */
static inline i4 four_before(size_t i, size_t end)
{
    const int32_t left = (int32_t)(end - i < FOUR ? end - i : FOUR);
    return (i4){0, 1, 2, 3} < (i4){left, left, left, left};
}

/* The same of a column that the loop writes: 0 from `end` on, where another thread may write. */
static inline f4 four_get(const float *column, size_t i, size_t end)
{
    f4 value = {0, 0, 0, 0};
    if (i + FOUR <= end)
        return f4_load(column, i);
    memcpy(&value, column + i, (end - i) * sizeof *column);
    return value;
}

/* Stores the results of particles i to i + 3 before `end`. */
static inline void four_put(void *column, size_t i, size_t end, f4 value)
{
    float *const to = (float *)column + i;
    if (i + FOUR <= end)
        memcpy(to, &value, sizeof value);
    else
        memcpy(to, &value, (end - i) * sizeof *to);
}

/* walls_near of sim/box/box.h. */
static inline i4 four_near_walls(const WallsFar *far, f4 x, f4 y, f4 z)
{
    return (x < f4_splat(far->low[0])) | (x > f4_splat(far->high[0])) | (y < f4_splat(far->low[1])) |
           (y > f4_splat(far->high[1])) | (z < f4_splat(far->low[2])) | (z > f4_splat(far->high[2]));
}

#endif
