/* Friction with the velocities at the end of a step: the passes that solve for them, and their columns.

   after: M. Weiler, D. Koschier, M. Brand, J. Bender, "A physically consistent implicit viscosity solver for
   SPH fluids", 2018

   With v the velocities at a step's begin and a the accelerations of all else, gravity among them, the change
   d of velocity obeys
     (m_i / dt + K_i) d_i + B_i d_i - L(d)_i = m_i a_i + friction_i(v)
     L(d)_i = sum c_ij (d_ji . x_ij) x_ij
     c_ij = V_i V_j (mu_i + mu_j) R F, radial: sim/matter/viscosity.h
     B_i = 2 sum c_ib x_ib x_ib^T, of boundary particles of solids, as if they had -d_i
   K_i is what walls that hold the fluid have for its velocity (sim/box/wall_drag.h); of walls that let it
   slip L has the images (sim/box/wall_images.h), with d in the mirror. The left side is symmetric and
   positive. friction_i is the explicit one, with boundary particles as sim/cpu/boundary.c fills them: so a
   short step does what an explicit one does, and flow that is steady is the explicit one's, whatever B is.
   But for corrected gradients, which give explicit friction a factor of 1 + tr C / d from each of a pair:
   friction_i as L has none of it.
   The radial form and no other: it leaves a body that turns as a whole alone, and Morris's, which brakes it,
   would hold it fast at such viscosities.

   Conjugate gradients with one product an iteration (A. T. Chronopoulos, C. W. Gear, "s-step iterative
   methods for symmetric linear systems", 1989), preconditioned by the blocks D_i of 3 x 3. They begin with
   the friction of the step before, which is a part of the saved state, and with all else as it is now: the
   sums of the right side are then those of the residual, with v + d for v, and cost nothing more. Fluid that
   falls or creeps needs few iterations so. There is one at least: friction that is out of date in a corner of
   the fluid, and little beside the speed of the rest, would go on pushing.

   What is left of the residual is a force that the fluid was not given: the next step's right side has it
   (`friction_left`). So what iterations leave does not add up, whatever the tolerance: momentum is out by
   that of one step, of fluid that turns too, whose friction of the step before pulls to where the middle was
   then; and steady flow has no part of it. */
#ifndef SLOSH_VISCOSITY_PASSES_H
#define SLOSH_VISCOSITY_PASSES_H

#include "sim/cpu/pass.h"

/* Of what goes on from step to step. */
enum {
    BEFORE = COLUMNS_KEPT, /* what friction adds to the acceleration, m/s2: 3 */
    LEFT = BEFORE + 3,     /* residual times dt / m, m/s: 3 */
};

/* Where its other columns stand among those of terms. */
enum {
    CHANGE,                   /* d, m/s: 3 */
    RESIDUAL = CHANGE + 3,    /* what is left of the right side, N: 3 */
    DIRECTION = RESIDUAL + 3, /* p, m/s: 3 */
    ALONG = DIRECTION + 3,    /* A p, N: 3 */
    PRODUCT = ALONG + 3,      /* A z, N; z, m/s, is what `motion` has: 3 */
    INVERSE = PRODUCT + 3,    /* of D, s/kg: xx, yy, zz, xy, yz, zx */
    HELD = INVERSE + 6,       /* B, kg/s: the same */
    INERTIA = HELD + 6,       /* m / dt + K, kg/s */
    MISS,                     /* |residual| dt / m, m/s */
    SCALE,                    /* |v| + dt (|a| + |g|): MISS counts in its mean, m/s */
    POWER,                    /* residual . z, W */
    CURVATURE,                /* z . A z, W */
};

extern const ColumnDef viscosity_columns[];

/* Right side, blocks; where the iterations begin. */
extern const Pass viscosity_begin;

/* An iteration: along the next direction; the product behind it. */
extern const Pass viscosity_step, viscosity_product;

/* The accelerations that make d. */
extern const Pass viscosity_end;

#endif
