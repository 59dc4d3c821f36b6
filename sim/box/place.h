/* Positions in wide boxes. A step adds v dt in single precision, and increments below half of the last
   digit are lost. In a box 400 spacings wide the loss is 1e-5 spacings per half step, so slow fluid stands
   still. In wide boxes a particle keeps the rounding remainder of its position (column `remainder`), and
   the next step adds the remainder.

   A position relative to the cell would keep as many digits, but then pair sums, walls, views and files
   would need the cell. Instead they read the rounded position, and only the stepping knows the remainder.

   After: W. Kahan, "Further remarks on reducing truncation errors", 1965; the sum without comparison is
   from D. E. Knuth, "The Art of Computer Programming", vol. 2, sec. 4.2.2. */
#ifndef SLOSH_PLACE_H
#define SLOSH_PLACE_H

#include <stddef.h>

#ifdef __FAST_MATH__
#error "what rounding leaves is 0 under -ffast-math"
#endif

/* Adds `way` to a coordinate, m. `left`: rounding remainder so far, at most half of the last digit; NULL:
   remainders are lost. */
static inline void place_move(float *x, float *left, float way)
{
    if (!left) {
        *x += way;
        return;
    }
    const float sum = *x + way, added = sum - *x;
    const float all = *left + ((*x - (sum - added)) + (way - added));
    *x = sum + all;
    *left = all - (*x - sum);
}

/* For a position set explicitly: clears the remainder of changed coordinates. */
static inline void place_put(const float before[3], const float x[3], float left[3])
{
    for (int k = 0; left && k < 3; k++)
        left[k] = x[k] == before[k] ? left[k] : 0;
}

#endif
