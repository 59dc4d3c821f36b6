/* When a coarse level (sim/step/backend.h) corrects, and how far: shared by C and shaders. */
#ifndef SLOSH_COARSE_RULE_H
#define SLOSH_COARSE_RULE_H

/* An iteration carries an error a support radius further: long waves need many iterations. A correction is
   due after COARSE_AFTER iterations, and each COARSE_EVERY further, where the solver is slow. It is slow if
   COARSE_WORTH more iterations of the effect of the last two would not reach the tolerance. */
#define COARSE_AFTER 2
#define COARSE_EVERY 4
#define COARSE_WORTH 5

#define COARSE_CORNERS 8 /* of a cell: bit k of a corner's number: the far end along axis k */

/* Thin fluid is left to iterations: where sum hold is not less than this part of sum weight, few cells lie
   between surfaces, and a correction saves no iterations. Heaved tanks of 20 layers have 0.20 in the plane
   and 0.25 in space, and gain. Those of 10 layers have 0.43, with a loss of a quarter, and 0.52, with a gain
   of a quarter. */
#define COARSE_THIN 0.4F

#define COARSE_LEFT            0.01F  /* part of the residual of v that may be left: the iterations go on */
#define COARSE_ITERATIONS_MOST 400    /* of conjugate gradients */
#define COARSE_PART_MOST       100.0F /* a hold or residual of a particle counts so much at most */

#endif
