/* Outline of the box at the hand's target, beside the drawn box: while time is paused or slow the box
   follows much later, and users would move it blindly without an outline. Pure. */
#ifndef SLOSH_OUTLINE_H
#define SLOSH_OUTLINE_H

#include "sim/box/box_filter.h"

#include <stdbool.h>

enum { OUTLINE_EDGES = 12 };

/* Fills in the box's pose at `time` after reaching the target: prescribed motions plus the hand's part.
   `box_height` in m. */
void outline_pose(const Motion motions[], int count, double box_height, double time, const BoxTarget *target,
                  BoxState *pose);

/* Returns the greatest distance between corresponding corners, in longest sides of the box. */
double outline_apart(const BoxState *a, const BoxState *b, const double box_size[3]);

/* Returns true if the outline must be visible: appears when the box lags behind the hand, paused or slow,
   and stays until the box arrives. `apart`: from outline_apart. */
bool outline_follow(bool shown, bool lags, double apart);

/* Fills in both ends of an edge in the box's frame, m. */
void outline_edge(const double box_size[3], int edge, double a[3], double b[3]);

#endif
