/* Terms that any method may have: the acceleration for output, and implicit viscosity. */
#ifndef SIM_METHODS_SHARED_TERMS_H
#define SIM_METHODS_SHARED_TERMS_H

#include "sim/cpu/cpu.h"
#include "sim/step/method.h"

/* The acceleration of each particle in the last step, for output: velocity change over the step's time,
   both in the box's frame. Includes every effect of a step on velocities, for any method: pressure,
   friction, gravity, the box's motion, walls and solids, emitters, and a method's corrections of velocities
   or positions. Unknown (NaN) before the first step, and after loading a state without accelerations. Kept
   if WorldDef.acceleration is set; no step reads the column. */

/* The column with three components. Before a step's end: velocity at the step's begin, m/s. */
extern const ColumnDef change_columns[];

/* Passes over dt, s; dt 0: acceleration unknown. */
extern const Pass change_begin, change_end;

/* Friction with the velocities at the end of a step: the passes of the solver, and their columns.

   after: M. Weiler, D. Koschier, M. Brand, J. Bender, "A physically consistent implicit viscosity solver for
   SPH fluids", 2018

   With v the velocities at a step's begin and a all other accelerations, gravity included, the change d of
   velocity obeys
     (m_i / dt + K_i) d_i + B_i d_i - L(d)_i = m_i a_i + friction_i(v)
     L(d)_i = sum c_ij (d_ji . x_ij) x_ij
     c_ij = V_i V_j (mu_i + mu_j) R F, radial. sim/def/fluids.h
     B_i = 2 sum c_ib x_ib x_ib^T, over boundary particles of solids, as if they had -d_i
   K_i is the drag of walls without slip (sim/box/box.h). For walls with slip L includes images
   (sim/box/box.h), with d in the mirror. The left side is symmetric and positive. friction_i is the
   explicit friction, with boundary particles as filled by sim/cpu/boundary.c. So a short step acts like an
   explicit step, and steady flow is the same as with explicit friction, whatever B is. Corrected gradients
   are an exception: they give explicit friction a factor of 1 + tr C / d from each particle of a pair;
   friction_i, like L, has no such factor.
   Only the radial form is used: a body in rigid rotation keeps turning. Morris's form brakes rotation, and
   would hold the body fast at such viscosities.

   Conjugate gradients with one product per iteration (A. T. Chronopoulos, C. W. Gear, "s-step iterative
   methods for symmetric linear systems", 1989), preconditioned by the 3 x 3 blocks D_i. The iterations begin
   with the friction of the step before, a part of the saved state, and with all other accelerations as they
   are now. Then the sums of the right side are those of the residual, with v + d for v, at no extra cost. So
   falling or creeping fluid needs few iterations. At least one iteration runs: outdated friction in a corner
   of the fluid, small beside the speed of the rest, would go on pushing.

   The final residual is a force withheld from the fluid: the next step's right side includes that force
   (`friction_left`). So residuals do not add up, whatever the tolerance: momentum is off by the residual of
   one step. The same is true for fluid in rotation, where the friction of the step before pulls to the former
   place of the middle. Steady flow is unaffected. */

/* Columns kept from step to step. */
enum {
    BEFORE = COLUMNS_KEPT, /* acceleration by friction, m/s2: 3 */
    LEFT = BEFORE + 3,     /* residual times dt / m, m/s: 3 */
};

/* Other columns, among the columns of terms. */
enum {
    CHANGE,                   /* d, m/s: 3 */
    RESIDUAL = CHANGE + 3,    /* rest of the right side, N: 3 */
    DIRECTION = RESIDUAL + 3, /* p, m/s: 3 */
    ALONG = DIRECTION + 3,    /* A p, N: 3 */
    PRODUCT = ALONG + 3,      /* A z, N: 3; `motion` has z, m/s */
    INVERSE = PRODUCT + 3,    /* of D, s/kg: xx, yy, zz, xy, yz, zx */
    HELD = INVERSE + 6,       /* B, kg/s: the same */
    INERTIA = HELD + 6,       /* m / dt + K, kg/s */
    MISS,                     /* |residual| dt / m, m/s */
    SCALE,                    /* |v| + dt (|a| + |g|), m/s: MISS is measured in units of the mean */
    POWER,                    /* residual . z, W */
    CURVATURE,                /* z . A z, W */
};

extern const ColumnDef viscosity_columns[];

/* Right side, blocks, and first values of the iterations. */
extern const Pass viscosity_begin;

/* An iteration: a step along the next direction, then the product. */
extern const Pass viscosity_step, viscosity_product;

/* Accelerations from d. */
extern const Pass viscosity_end;

#endif
