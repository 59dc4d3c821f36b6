/* Walls of the box: positions, and the last guard that keeps particles inside. The pressure of the walls
   comes from images of the fluid: sim/box/wall_images.h. */
#ifndef SLOSH_WALL_H
#define SLOSH_WALL_H

#include <math.h>
#include <stdbool.h>

typedef struct Walls {
    int dimensions;     /* 2: no wall in z */
    bool open[3];       /* periodic: no wall across this axis */
    float half_size[3]; /* of the box, m; the box's frame has its floor at y = 0 */
    float spacing;      /* m */
} Walls;

void walls_place(Walls *walls, int dimensions, const double box_size[3], const bool open[3], double spacing);

/* Region without a near wall: box's frame, m. */
typedef struct WallsFar {
    float low[3], high[3];
} WallsFar;

/* The region further than `range` (m) from all walls; for 0, the inside of the box. */
static inline WallsFar walls_far(const Walls *walls, float range)
{
    WallsFar far;
    for (int a = 0; a < 3; a++) {
        const bool wall = a < walls->dimensions && !walls->open[a];
        const float half = walls->half_size[a];
        far.low[a] = wall ? (a == 1 ? 0 : -half) + range : -INFINITY;
        far.high[a] = wall ? (a == 1 ? 2 * half : half) - range : INFINITY;
    }
    return far;
}

/* True if a wall is near x: the only wall test for most of the fluid. */
static inline bool walls_near(const WallsFar *far, const float x[3])
{
    return (x[0] < far->low[0]) | (x[0] > far->high[0]) | (x[1] < far->low[1]) | (x[1] > far->high[1]) |
           (x[2] < far->low[2]) | (x[2] > far->high[2]);
}

/* True if x is in the box; false if x is not finite. */
bool walls_contain(const Walls *walls, const float x[3]);

/* Moves x into the box and removes the velocity into the wall; true if x changed. */
bool walls_guard(const Walls *walls, float x[3], float v[3]);

/* Folds x back into the box, up to half a spacing deep depending on the overshoot: particles that cross a
   wall in a step do not end up in a plane. v gains `rate` (1/s) times the shift. True if x changed. */
bool walls_fold(const Walls *walls, float rate, float x[3], float v[3]);

#endif
