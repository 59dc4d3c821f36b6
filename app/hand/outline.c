#include "app/hand/outline.h"

#include <math.h>
#include <string.h>

/* Distances to show and hide, in longest sides: some pixels for a box filling the picture; a line's width. */
static const double COMES = 0.02, GOES = 0.004;

void outline_pose(const Motion motions[], int count, double box_height, double time, const BoxTarget *target,
                  BoxState *pose)
{
    BoxFilter there = box_filter_at_rest();
    memcpy(there.position, target->position, sizeof there.position);
    memcpy(there.orientation, target->orientation, sizeof there.orientation);
    box_state_at(motions, count, box_height, time, pose);
    box_filter_apply(&there, box_height, pose);
}

static void corner_of(const double box_size[3], int corner, double at[3])
{
    for (int k = 0; k < 3; k++)
        at[k] = box_size[k] * ((corner >> k & 1) - (k == 1 ? 0 : 0.5)); /* the floor is at y = 0 */
}

double outline_apart(const BoxState *a, const BoxState *b, const double box_size[3])
{
    double longest = 0;
    for (int corner = 0; corner < 8; corner++) {
        double at[3], x[3], y[3];
        corner_of(box_size, corner, at);
        box_to_world(a, at, NULL, x, NULL);
        box_to_world(b, at, NULL, y, NULL);
        longest = fmax(longest, hypot(hypot(x[0] - y[0], x[1] - y[1]), x[2] - y[2]));
    }
    return longest / fmax(box_size[0], fmax(box_size[1], box_size[2]));
}

bool outline_follow(bool shown, bool lags, double apart)
{
    return shown ? apart > GOES : lags && apart > COMES;
}

/* Four edges along each axis. */
void outline_edge(const double box_size[3], int edge, double a[3], double b[3])
{
    const int axis = edge / 4, next = (axis + 1) % 3, other = (axis + 2) % 3;
    const int corner = (edge & 1) << next | (edge >> 1 & 1) << other;
    corner_of(box_size, corner, a);
    corner_of(box_size, corner | 1 << axis, b);
}
