/* Whether a closed world gains energy: a step that is too long for friction heats fluid at rest, and no
   particle need move far for it. Closed is a world without emitters, drains, solids that move, a lid, a
   finger, surface tension (whose energy is not known), or gravity or motion along a periodic axis, by a
   method that says its energy of compression or lets nothing be compressed. In the box's frame walls do no
   work; that of gravity and of the box's motion follows from sums over the particles at both ends of the time
   between two looks. On the CPU only: the sums of a GPU come when they come, and no two runs would go back at
   the same step. */
#ifndef SLOSH_ENERGY_WATCH_H
#define SLOSH_ENERGY_WATCH_H

#include "sim/world/world_struct.h"

/* After each step that is sound, and of the initial state. False when energy has grown, with the reason in
   world->seen; looks at the ends of frames only. */
bool energy_sound(World *world);

/* Something has done work, or changed what energy is: the next frame is the first to compare with. */
void energy_forget(World *world);

#endif
