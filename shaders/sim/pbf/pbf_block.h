/* The constants of pbf, of which C and shaders read the same; pbf_set of sim/pbf/pbf.c fills it. */
#ifndef SLOSH_PBF_BLOCK_H
#define SLOSH_PBF_BLOCK_H

#include "shaders/shared/block.h"
#include "shaders/sim/bindings.h"

/* A storage buffer, beside those of shaders/sim/bindings.h */
#define MOTIONS_BUFFER 7

/* How much of the iteration before goes on: half of the iterations. */
#define PBF_MOMENTUM 0.6F

/* What a step forgets of the multipliers, at most, and in the time to settle. With all of them what a blow
   left, or a tolerance, pushes again before it is taken back, and a column that rests jumps; with none there
   are half as many iterations more. A short step has one iteration as a rule, and a column hums at 0.1 m/s
   where less is forgotten. */
#define FORGOTTEN      0.5F
#define FORGOTTEN_RATE 3.0F

/* The longest way of an iteration, in spacings: fluid that a long step has folded comes apart in several,
   and is not thrown. What is cut short is lost to momentum. */
#define WAY_LONGEST 0.2F

/* The nearest that an iteration brings a particle to a wall, in spacings: right at a wall its image pushes it
   nowhere. */
#define WALL_LEAST 0.1F

/* The part that a step takes away of what is compressed when it begins, by dt over the time to settle: all of
   it in that time, in a shorter step as much less. Places that move become velocity, the way over dt, so that
   more in a short step would throw the fluid. (J. Baumgarte, "Stabilization of constraints and integrals of
   motion in dynamical systems", 1972) */
#define PBF_SHARE(times) ((times) < 1.0F ? (times) : 1.0F)

UNIFORM_BLOCK(PbfBlock, METHOD_BLOCK)
{
    float gradient;          /* F = -W'(r) / r over f(r / h), of the kernel that sums density, 1/m2 */
    float friction_gradient; /* the same calibrated for gradients (sim/kernel/lattice.h) */
    float relaxation;        /* of Jacobi */
    float least_squares;     /* a part of sum F^2 r^2 on the lattice, 1/m2: D is no less than that over m */
    float pressure_of_term;  /* p over k / dt^2 */
    float viscous_dt;        /* the longest step that friction stands, s */
    float settle_rate;       /* 1 over the time to settle, 1/s */
}
BLOCK_END(PbfBlock);

#endif
