/* What the fluid does to the box and to each solid, summed over steps: for who measures (Backend.feel). A
   world that is never asked pays nothing. */
#ifndef SLOSH_FORCES_H
#define SLOSH_FORCES_H

#include "sim/matter/world_def.h"

/* In the box's axes; summed over time, N s and N m s, or its mean, N and N m. */
typedef struct Push {
    double force[3], torque[3]; /* the torque about the box's origin; of a solid about the solid's own */
} Push;

/* The box's is all that fluid pushes on, less the solids: walls, and what is left of a guard. It leaves out
   what emitters and drains do. A solid's is the sum over its boundary particles of what these push the fluid
   with, the other way round: pressure, and friction but the implicit one, which is then in the box's. */
typedef struct Forces {
    double seconds; /* that were summed */
    Push box, solid[SOLIDS_MAX];
} Forces;

/* Adds `times` one to another. */
void push_add(Push *to, double times, const Push *push);

/* Adds a force (N) at x, m, from whence the torque counts. */
static inline void push_at(Push *push, const double x[3], const double force[3])
{
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        push->force[k] += force[k];
        push->torque[k] += x[next] * force[last] - x[last] * force[next];
    }
}

/* The same push with its torque about another point, which is at `to` (m) seen from the one before. */
void push_about(Push *push, const double to[3]);

/* Adds what is summed to what is summed. */
void forces_add(Forces *to, const Forces *sum);

/* Adds what is the mean of some time to what is summed. */
void forces_add_mean(Forces *to, const Forces *mean);

/* Means over the time that was summed; all 0 of none. */
void forces_mean(Forces *forces);

#endif
