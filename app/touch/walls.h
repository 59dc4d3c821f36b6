/* The walls of the box as handles: an arrow on each wall that can be moved, to be dragged along its normal.
   The floor stays where it is; walls across from each other move together, since the middle of the floor
   stays. Pure: no window, no GL. Places are in the box's frame, m. */
#ifndef SLOSH_APP_WALLS_H
#define SLOSH_APP_WALLS_H

#include "render/frame/handle.h"

#include <stdbool.h>

enum { WALL_HANDLES_MAX = 5 };

/* Writes the arrows of the walls that are not open, and returns how many there are. */
int wall_handles(const double size[3], const bool open[3], int dimensions, Handle handles[WALL_HANDLES_MAX]);

/* The arrow `taken` was dragged to `at`: `size` gets the box's size that puts its wall there along its axis,
   at least `least`. */
void wall_drag(const Handle *taken, const double at[3], double least, double size[3]);

#endif
