/* Places in wide boxes. A step adds v dt to a place in single precision, and what is less than half of the
   place's last digit is lost: 400 spacings wide, 1e-5 spacings in each half step, so that slow fluid stands.
   There a particle keeps what rounding leaves of its place (the column `remainder`), and the next step adds
   it again. A place within its cell would keep as many digits, but pair sums, walls, views and files would
   all have to know the cell; so they read the rounded place, as ever, and stepping alone knows the rest.

   After: W. Kahan, "Further remarks on reducing truncation errors", 1965; the sum without comparison is from
   D. E. Knuth, "The Art of Computer Programming", vol. 2, sec. 4.2.2. */
#ifndef SLOSH_PLACE_H
#define SLOSH_PLACE_H

#include <stddef.h>

#ifdef __FAST_MATH__
#error "what rounding leaves is 0 under -ffast-math"
#endif

/* Adds `way` to a coordinate, m; `left` is what rounding has left of it so far, at most half of its last
   digit. NULL: what rounding leaves is lost. */
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

/* Of a place that was put to where it is: nothing is left where it has changed. */
static inline void place_put(const float before[3], const float x[3], float left[3])
{
    for (int k = 0; left && k < 3; k++)
        left[k] = x[k] == before[k] ? left[k] : 0;
}

#endif
