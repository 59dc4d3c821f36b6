/* The user's changes of the box's size while a simulation runs. */
#ifndef SLOSH_BOX_COMMAND_H
#define SLOSH_BOX_COMMAND_H

#include "sim/base/error.h"

#include <stdbool.h>

/* Greatest shrinking of a side at a time, in spacings: a small bite squeezes the fluid less than its own
   waves do. */
#define BOX_BITE 0.04

/* Least length of a side, in spacings. */
#define BOX_LEAST 6

struct World;
struct WorldDef;

/* Resizes the box (m) at once, but shrinks at most by BOX_BITE along each axis: callers repeat for more. The
   centre of the floor stays. Rebuilds the world, which takes about as long as opening the scene: `world` is
   replaced, and `def` is its new definition. Returns false with the reason, without changes: not finite, too
   small for the particles or the method, or a periodic side. */
bool box_command_apply(const double size[3], struct World **world, struct WorldDef *def, Error *error);

#endif
