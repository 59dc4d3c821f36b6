/* The acceleration of each particle in the last step, for who looks: the change of its velocity over the time
   of the step, both in the box's frame. All that a step does to a velocity counts, whatever the method:
   pressure, friction, gravity, the box's own motion, walls and solids, emitters, and what a method corrects
   velocities or places by. Not known (NaN) before the first step, and
   in a state that was saved without it. A world keeps it where WorldDef.acceleration says so; no step reads
   it. */
#ifndef SLOSH_CHANGE_H
#define SLOSH_CHANGE_H

#include "sim/world/method.h"

/* The column of three: before a step's end the velocity that the step began with, m/s. */
extern const ColumnDef change_columns[];

/* Over dt, s; 0: not known. */
extern const Pass change_begin, change_end;

#endif
