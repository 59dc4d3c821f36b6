/* The walls of the box where density is summed (where it is carried: sim/box/wall_images.h), as fluid would
   see a lattice of particles at rest behind them.

   Behind each wall stands a half-space of lattice particles, the first layer half a spacing away. What it
   adds to the sums of a particle in front of it depends on the distances alone and is tabulated at start: for
   one face, for the quadrant behind two faces and for the octant behind three. The union of half-spaces at an
   edge or a corner is then faces - quadrants + octants (inclusion and exclusion): adding faces alone would
   count the particles behind two of them twice, the known way to blow up in a corner.

   Tables are means over the lattice's positions along the wall, scaled so that the lattice at rest finds
   exactly the density that its own continuation would give.

   The force is the gradient of that same density, -p_i V_i^2 grad lambda: particles and walls then have one
   energy, sum e(n_i), and nothing heats the fluid, as long as there is no gravity. But the lattice at rest
   needs twice the gradient of the half-space, since fluid behind the wall would push with p_j as well. So the
   tables are read not at the distance d but at u(d), which is d at the layers of the lattice (1/2, 3/2, ...
   spacings) and has slope 2 there: density and force are both right at rest.

   Near two walls at once the tables alone push ever less (in a corner of three walls by a seventh of the push
   at rest): such a particle is within the lattice behind, and fluid half a spacing in front would hold it
   there for good. So from 0.37 spacings on, nearer than which fluid at rest does not come, the edge has more
   density, and its gradient: at the wall the push is that at rest again.

   With w = -W'(r) / r of the pressure kernel and x = x_i - x_j, a wall particle whose pressure continues the
   fluid's hydrostatically, p_j = p_i - rho0 g.x, adds -V_i V_j rho0 w (x x^T) g; the moment m = sum w x x^T
   sums that up. Its part along the wall is what keeps fluid at a side wall from sinking. */
#ifndef SLOSH_WALL_H
#define SLOSH_WALL_H

#include "sim/kernel/lattice.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* Sums over the lattice particles behind k faces whose normals (into the box) are the first k axes. */
typedef struct WallSums {
    float number_density; /* sum W, 1/m3 */
    float push[3];        /* sum w x_a u'(d_a), 1/m4; scaled by Lattice.gradient_scale */
    float moment[6];      /* sum w x_a x_b: xx yy zz xy yz zx, 1/m3; the same scale */
} WallSums;

/* Nodes of a table: u = k * step - spacing / 4, the half spacing among them. Entries: face n, edge n * n,
   corner n * n * n; the last index runs fastest. */
typedef struct WallTable {
    int nodes;
    float inverse_step; /* 1/m */
    WallSums *sums;     /* owned */
} WallTable;

typedef struct Walls {
    int dimensions;     /* 2: no wall in z */
    bool open[3];       /* periodic: no wall across this axis */
    float half_size[3]; /* of the box, m; the box's frame has its floor at y = 0 */
    float range;        /* beyond this distance a wall adds nothing, m */
    float spacing;      /* m */
    WallTable table[3]; /* face, edge, corner */
} Walls;

/* Entries of the first so many tables together: that of t + 1 faces has nodes^(t + 1). */
size_t walls_entries(const Walls *walls, int tables);

/* The walls without tables, where they are mirrors: sim/box/wall_images.h. */
void walls_place(Walls *walls, int dimensions, const double box_size[3], const bool open[3], double spacing);

/* With tables; false when memory is short. */
bool walls_create(Walls *walls, const double box_size[3], const bool open[3], double spacing,
                  double support_radius, const Kernel *density_kernel, const Lattice *lattice);
void walls_destroy(Walls *walls);

/* Where no wall is near: box's frame, m. */
typedef struct WallsFar {
    float low[3], high[3];
} WallsFar;

/* Of walls that are farther than `range`, m; of 0: within the box. */
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

/* Whether a wall is near to x: what most of the fluid is asked, and no more. */
static inline bool walls_near(const WallsFar *far, const float x[3])
{
    return (x[0] < far->low[0]) | (x[0] > far->high[0]) | (x[1] < far->low[1]) | (x[1] > far->high[1]) |
           (x[2] < far->low[2]) | (x[2] > far->high[2]);
}

/* Adds up what the walls give at x (box's frame, m, inside the box), in the box's axes; false, and zero, when
   no wall is within range. */
bool walls_at(const Walls *walls, const float x[3], WallSums *sums);

/* Only the number density of it. */
float walls_number_density(const Walls *walls, const float x[3]);

/* Whether x is in the box; false for what is not finite. */
bool walls_contain(const Walls *walls, const float x[3]);

/* Holds x inside the box and takes the velocity into the wall away; true if it had to. */
bool walls_guard(const Walls *walls, float x[3], float v[3]);

/* Brings x back into the box, up to half a spacing deep by how far it went: so that what one step takes
   through a wall does not come to lie on one plane. v gains `rate` (1/s) times the way. True if it had to. */
bool walls_fold(const Walls *walls, float rate, float x[3], float v[3]);

/* The distance u at which the tables are read for the distance d, m, and its slope. */
float wall_distance(float d, float spacing, float *slope);

/* For tests: the sums at the table distances `u` of the first `faces` axes by adding lattice particles up,
   shifted by `offset` (in spacings) along the other axes; the push without its slope. */
void wall_sums_brute(int faces, const double u[3], const double offset[3], double spacing,
                     double support_radius, const Kernel *density_kernel, const Lattice *lattice,
                     double number_density[1], double push[3], double moment[6]);

#endif
