/* What a user does to the size of the box while a simulation runs. */
#ifndef SLOSH_BOX_COMMAND_H
#define SLOSH_BOX_COMMAND_H

#include "sim/base/error.h"

#include <stdbool.h>

/* Spacings by which a side shrinks at a time: the wall then squeezes the fluid by less than waves of its own
 * do. */
#define BOX_BITE 0.04

/* Spacings that a side has at least. */
#define BOX_LEAST 6

struct World;
struct WorldDef;

/* The box becomes so wide, high and deep (m) at once; where it is to be smaller, by BOX_BITE at
   most along each axis: who wants more asks again. The middle of its floor stays where it is. Makes the world
   anew, which takes about as long as opening its scene did: `world` becomes another one, `def` is that of its
   scene. False with the reason: not finite, too small for its particles or for the method, a side that is
   periodic; nothing has changed. */
bool box_command_apply(const double size[3], struct World **world, struct WorldDef *def, Error *error);

#endif
