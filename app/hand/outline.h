/* The box as the hand wants it, beside the one that is drawn: while time is paused or goes slowly the box
   follows much later, and without an outline of its goal one would move it blindly. Pure. */
#ifndef SLOSH_OUTLINE_H
#define SLOSH_OUTLINE_H

#include "sim/box/box_filter.h"

#include <stdbool.h>

enum { OUTLINE_EDGES = 12 };

/* Where the box is at that time when it has come to the target: its prescribed motions, and the hand's part
   on top. `box_height` in m. */
void outline_pose(const Motion motions[], int count, double box_height, double time, const BoxTarget *target,
                  BoxState *pose);

/* The longest way from a corner of the one to that of the other, in longest sides of the box. */
double outline_apart(const BoxState *a, const BoxState *b, const double box_size[3]);

/* Whether the outline is to be seen: it comes where the box lags behind the hand, paused or slow, and then
   stays until the box is there. `apart` as of outline_apart. */
bool outline_follow(bool shown, bool lags, double apart);

/* Both ends of an edge in the box's frame, m. */
void outline_edge(const double box_size[3], int edge, double a[3], double b[3]);

#endif
