/* Positions in wide boxes. A step adds v dt in single precision, and increments below half of the last
   digit are lost. In a box 400 spacings wide the loss is 1e-5 spacings per half step, so slow fluid stands
   still. In wide boxes a particle keeps the rounding remainder of its position (column `remainder`), and
   the next step adds the remainder.

   A position relative to the cell would keep as many digits, but then pair sums, walls, views and files
   would need the cell. Instead they read the rounded position, and only the stepping knows the remainder.

   After: W. Kahan, "Further remarks on reducing truncation errors", 1965; the sum without comparison is
   from D. E. Knuth, "The Art of Computer Programming", vol. 2, sec. 4.2.2. */
#ifndef SIM_BOX_BOX_STEP_H
#define SIM_BOX_BOX_STEP_H

#include "slosh/def.h"

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

/* From a pose of the box to the next: maps a free particle's position and velocity in the box's frame. The
   map is straight flight in the world, seen from both poses: exact changes of the box's velocity and
   rotation, Coriolis as a rotation, no sampled acceleration. So nothing drifts. */

/* With D = R1^T R0 - I, x1 = (I + D) (x0 + (v0 + omega0 x x0) dt - shift),
   v1 = (I + D) (v0 + omega0 x x0) - velocity_change - omega1 x x1.
   D is kept apart from I, since near-identity rotations rounded to float would shrink or grow the fluid. */
typedef struct BoxStep {
    bool still;                     /* the box does not move: x1 = x0 + v0 dt */
    float dt;                       /* s */
    float rotation[3][3];           /* D */
    float omega0[3];                /* angular velocity at the begin, in the axes of the begin, rad/s */
    float omega1[3];                /* at the end, in the axes of the end */
    float shift[3];                 /* P1 - P0 - V0 dt of the box's origin, in the axes of the begin, m */
    float velocity_change[3];       /* V1 - V0 of the box's origin, in the axes of the end, m/s */
    const struct SolidStep *solids; /* steps of the solids; NULL without solids */
} BoxStep;

void box_step(const BoxState *begin, const BoxState *end, double dt, BoxStep *step);

/* Apparent gravity of a body at rest in the box, in the box's axes of `middle`, from velocities at both
   ends of a step: gravity minus the box's acceleration. At x: origin - alpha x x - omega x (omega x x). */
typedef struct ApparentGravity {
    float origin[3]; /* m/s2 */
    float alpha[3];  /* rad/s2 */
    float omega[3];  /* rad/s */
} ApparentGravity;

void apparent_gravity(const double gravity[3], const BoxState *begin, const BoxState *middle,
                      const BoxState *end, double dt, ApparentGravity *out);

static inline void box_cross(const float a[3], const float b[3], float out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Applies the step to a particle. `left`: rounding remainder of the position (sim/box/box_step.h), or NULL.
 */
static inline void box_advance(const BoxStep *step, float x[3], float left[3], float v[3])
{
    if (step->still) {
        for (int k = 0; k < 3; k++)
            place_move(&x[k], left ? &left[k] : NULL, v[k] * step->dt);
        return;
    }
    float swirl[3], w[3], y[3];
    box_cross(step->omega0, x, swirl);
    for (int k = 0; k < 3; k++) {
        w[k] = v[k] + swirl[k];
        y[k] = x[k];
        place_move(&y[k], left ? &left[k] : NULL, w[k] * step->dt - step->shift[k]);
    }
    for (int k = 0; k < 3; k++) {
        x[k] = y[k];
        place_move(&x[k], left ? &left[k] : NULL,
                   step->rotation[k][0] * y[0] + step->rotation[k][1] * y[1] + step->rotation[k][2] * y[2]);
    }
    box_cross(step->omega1, x, swirl);
    for (int k = 0; k < 3; k++)
        v[k] = w[k] +
               (step->rotation[k][0] * w[0] + step->rotation[k][1] * w[1] + step->rotation[k][2] * w[2]) -
               step->velocity_change[k] - swirl[k];
}

/* The apparent gravity at x. */
static inline void apparent_gravity_at(const ApparentGravity *gravity, const float x[3], float out[3])
{
    float euler[3], inner[3], outer[3];
    box_cross(gravity->alpha, x, euler);
    box_cross(gravity->omega, x, inner);
    box_cross(gravity->omega, inner, outer);
    for (int k = 0; k < 3; k++)
        out[k] = gravity->origin[k] - euler[k] - outer[k];
}

#endif
