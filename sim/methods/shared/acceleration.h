/* The acceleration of each particle in the last step, for output: velocity change over the step's time,
   both in the box's frame. Includes every effect of a step on velocities, for any method: pressure,
   friction, gravity, the box's motion, walls and solids, emitters, and a method's corrections of velocities
   or positions. Unknown (NaN) before the first step, and after loading a state without accelerations. Kept
   if WorldDef.acceleration is set; no step reads the column. */
#ifndef SIM_METHODS_SHARED_ACCELERATION_H
#define SIM_METHODS_SHARED_ACCELERATION_H

#include "sim/step/method.h"

/* The column with three components. Before a step's end: velocity at the step's begin, m/s. */
extern const ColumnDef change_columns[];

/* Passes over dt, s; dt 0: acceleration unknown. */
extern const Pass change_begin, change_end;

#endif
