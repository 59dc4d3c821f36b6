/* Whether a world gains energy without work done: a step that is too long for friction heats fluid at rest,
   and no particle need move far for it. Energy is that of motion and of compression, of fluids and of solids
   that float, by a method that says its energy of compression or lets nothing be compressed. Less the work
   done meanwhile it does not grow. Work is that

   - of gravity and of the box's motion, by sums over the particles at two looks; where the box's velocity
     jumps these stand at both ends of that step;
   - of solids on ways of their own, by the forces on them;
   - of emitters: what comes brings its own, and they hold it to its course. What leaves takes its own along.

   Of a surface's energy only a bound is known: tension may free all that was there, as a lid may drag fluid
   along to its own speed. Who touches the fluid with a finger is not watched.

   On a GPU the gauge is read now and then, at the end of a frame whose numbers were waited for. It has no
   momenta: a box that moves is not watched there, nor emitters, solids on ways of their own, or gravity along
   a periodic axis. */
#ifndef SLOSH_ENERGY_WATCH_H
#define SLOSH_ENERGY_WATCH_H

#include "sim/world/world_struct.h"

/* After each step that is sound (on a GPU: each frame), and of the initial state. False when energy has
   grown, with the reason in world->seen; compares at the ends of frames only. */
bool energy_sound(World *world);

/* Before a step, with the box at its begin; world->box is at its end. */
void energy_brace(World *world, const BoxState *begin);

/* So many particles of a layer have come in. */
void energy_comes(World *world, const EmitLayer *layer, size_t number);

/* Work was done on what is watched, J. */
void energy_works(World *world, double work);

/* Whether it needs what solids feel; then, after each step, that and where they were. */
bool energy_asks_solids(const World *world);
void energy_of_solids(World *world, const Forces *felt, const SolidStep solids[SOLIDS_MAX]);

/* Something has done work that nobody counts, or changed what energy is: the next frame is the first to
 * compare with. */
void energy_forget(World *world);

#endif
