/* Another size of the box without another world. */
#ifndef SLOSH_RESIZE_H
#define SLOSH_RESIZE_H

#include "sim/base/error.h"
#include "sim/matter/world_def.h"

#include <stdbool.h>

struct World;

/* Whether the box may become that of `def` where the world stands: without solids, and inside the cells that
   were made for it. Else the world is to be made anew. */
bool world_resizes(const struct World *world, const WorldDef *def);

/* Does so from the next step on; particles that a smaller box leaves outside come to its walls. False with
   the reason: no memory, or the state is not sound; nothing has changed. */
bool world_resize(struct World *world, const WorldDef *def, Error *error);

/* Particles of a state come into the box of `def` along an axis. */
struct WorldState;
void world_bring_in(struct WorldState *state, const WorldDef *def, int axis);

#endif
