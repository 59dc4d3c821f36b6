/* Forces of the fluid on the box and on each solid, summed over steps, on request (Backend.feel). Without a
   request a world pays nothing. */
#ifndef SLOSH_FORCES_H
#define SLOSH_FORCES_H

#include "sim/matter/world_def.h"

/* In the box's axes. Summed over time: N s and N m s; as a mean: N and N m. */
typedef struct Push {
    double force[3], torque[3]; /* the torque about the box's origin; for a solid about the solid's own
                                   origin */
} Push;

/* The box's push is all push of the fluid less the solids': walls, and the rest of a guard, without emitters
   and drains. A solid's push is the reaction to the push of the solid's boundary particles on fluid: pressure
   and explicit friction. Implicit friction counts in the box's push. */
typedef struct Forces {
    double seconds; /* summed time */
    Push box, solid[SOLIDS_MAX];
} Forces;

/* Adds `times` push to `to`. */
void push_add(Push *to, double times, const Push *push);

/* Adds a force (N) at x, m from the point of the torque. */
static inline void push_at(Push *push, const double x[3], const double force[3])
{
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        push->force[k] += force[k];
        push->torque[k] += x[next] * force[last] - x[last] * force[next];
    }
}

/* Moves the torque to another point, at `to` (m) from the old point. */
void push_about(Push *push, const double to[3]);

/* Adds sums to sums. */
void forces_add(Forces *to, const Forces *sum);

/* Adds a mean over some time to sums. */
void forces_add_mean(Forces *to, const Forces *mean);

/* Turns sums into means over the summed time; all 0 without time. */
void forces_mean(Forces *forces);

#endif
