/* The walls of the box as handles: an arrow on each movable wall, dragged along the wall's normal. The
   floor stays; opposite walls move together, as the middle of the floor stays. Pure: no window, no GL.
   Positions are in the box's frame, m. */
#ifndef SLOSH_APP_WALLS_H
#define SLOSH_APP_WALLS_H

#include "render/frame/handle.h"

#include <stdbool.h>

enum { WALL_HANDLES_MAX = 5 };

/* Fills in the arrows of the walls that are not open; returns their count. */
int wall_handles(const double size[3], const bool open[3], int dimensions, Handle handles[WALL_HANDLES_MAX]);

/* Handles a drag of the arrow `taken` to `at`: `size` gets the new box size, at least `least` along the
   axis. */
void wall_drag(const Handle *taken, const double at[3], double least, double size[3]);

#endif
