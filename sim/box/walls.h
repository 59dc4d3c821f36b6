/* Periodic sides: particles that leave there enter on the opposite side, and neighbours see each other
   across. After: M. P. Allen, D. J. Tildesley, "Computer Simulation of Liquids", 1987, sec. 1.5.2.
   Positions stay in [low, low + size], up to single-precision rounding (on cpu from the end of a step on).
   Along a periodic axis the box is at least two support radii wide, so that no particle sees a neighbour
   twice. */
#ifndef SIM_BOX_WALLS_H
#define SIM_BOX_WALLS_H

#include "shaders/sim/box/wall_cushion_part.h"
#include "sim/box/box_step.h"
#include "sim/kernel/kernel.h"

#include <math.h>
#include <stdbool.h>

typedef struct Periodic {
    bool any;
    bool axis[3];
    float low[3], size[3]; /* m, of all axes */
} Periodic;

/* Wraps x (m) into the box along the periodic axes. `left`: rounding remainder of x, or NULL. */
static inline void periodic_wrap(const Periodic *periodic, float x[3], float left[3])
{
    for (int k = 0; k < 3; k++) {
        const float size = periodic->size[k], from = x[k] - periodic->low[k];
        if (periodic->axis[k] && !(from >= 0 && from < size))
            place_move(&x[k], left ? &left[k] : NULL, -size * floorf(from / size));
    }
}

/* Replaces d, a difference of two positions (m), by its shortest image. */
static inline void periodic_nearest(const Periodic *periodic, float d[3])
{
    for (int k = 0; k < 3; k++)
        if (periodic->axis[k])
            d[k] -= periodic->size[k] * rintf(d[k] / periodic->size[k]);
}

/* Walls of the box: positions, and the last guard that keeps particles inside. The pressure of the walls
   comes from images of the fluid: sim/box/walls.h. */

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

/* Keeps fluid drawn by gravity from lying on a wall. Images in a wall push with their fluid's pressure, and
   not harder at a smaller distance. At the edge of a free surface the pressure is nearly 0 and neighbours are
   on a single side. So the outermost row would come to lie on the wall (1 % of a spinning bucket's
   particles). Within a third of a spacing of the wall, such a particle rests on a spring:

     a = CUSHION_PUSH |g_n| (1 - d / reach) along the normal, if gravity draws the particle to the wall.

   The spring fades to 0 as the particle leaves the wall. Walls of repelling particles have forces of
   gravity's size too (J. J. Monaghan, "Simulating free surface flows with SPH", 1994; J. J. Monaghan, J. B.
   Kajtar, "SPH particle boundary forces for arbitrary boundaries", 2009). The spring returns at most
   CUSHION_LEAVES^2 / 2 |g_n| spacing of energy per mass, for any change of pressure in the meantime: with a
   full spring, a puddle of four particles gained energy. There is no force along the wall, and no force if
   gravity draws away from the wall. Under the pressure of a few layers the spring is negligible. */

/* Adds to the acceleration a, m/s2, of a particle at x (box's frame, m) with velocity v, m/s, and gravity
   g, m/s2, over a step dt (s). Weaker if the step is too long for the spring; nothing for dt = 0. */
void walls_cushion(const Walls *walls, float dt, const float g[3], const float x[3], const float v[3],
                   float a[3]);

/* Share of the cushion: fades in over a quarter of the pressure of a layer (`layer`, kg/m2), so that a lone
   particle falls to the wall without a cushion. */
static inline float cushion_share(float pressure, float layer, const float g[3])
{
    const float weight = CUSHION_FADE * layer * sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    return weight > 0 ? fminf(fmaxf(pressure / weight, 0), 1) : 0;
}

/* No-slip walls of the box: friction with a lattice of wall particles behind the walls.

   After: J. P. Morris, P. J. Fox, Y. Zhu, "Modeling low Reynolds number incompressible flows using SPH",
   1997, sec. 3.7. For fluid at distance d from a wall, a wall particle at depth u has the mirrored velocity
   -v u / max(d, spacing / 2), so that velocities continue linearly through zero at the wall. Then all
   viscous pair terms of a wall are proportional to the fluid particle's velocity:

     force_i = -mu_i V_i V0 D v_i, D = sum w(r) (1 + u / max(d, spacing / 2)), V0 = 1 / n0

   over the wall particles, where w is the pair weight of the method's viscosity. D times a volume chosen by
   the caller, to fit in a float for any spacing, is tabulated over the distances: faces - edges + corners.
   A wall particle behind several faces has the greatest of their factors, so edges and corners are
   tabulated with the least.

   The wall's lattice continues the lattice of the particle: a linear shear is free of force on the lattice
   at rest, up to rounding, in every layer. Over positions of the lattice along the wall, D varies by 3 %. */

typedef struct WallDrag {
    int dimensions;        /* 2: no wall in z */
    bool open[3];          /* periodic: no wall across this axis */
    float half_size[3];    /* of the box, m; the box's frame has its floor at y = 0 */
    float range;           /* beyond this distance a wall has no effect, m */
    int nodes[3];          /* nodes per side in the tables of faces, edges, corners: at d = k /
                              inverse_step */
    float inverse_step[3]; /* 1/m */
    float *table[3];       /* owned; the last index runs fastest; NULL: not created, or no corners in 2D */
} WallDrag;

typedef enum DragWeight { DRAG_LAPLACIAN, DRAG_MORRIS, DRAG_RADIAL } DragWeight;

/* w(r), 1/m5, of a wall particle at distance `normal` along the wall's normal: Müller's Laplacian; 2 F,
   which is -2 W'(r) / r with the pressure kernel; or the radial form of sim/def/fluids.h for
   velocities along the wall, 2 R F (r^2 - normal^2) / (dimensions - 1), used for all velocities: there is
   no velocity across the wall. */
double wall_drag_weight(const Lattice *lattice, DragWeight weight, double r, double normal,
                        double support_radius);

/* Returns false if memory is short. */
bool wall_drag_create(WallDrag *drag, const double box_size[3], const bool open[3], double spacing,
                      double support_radius, const Lattice *lattice, double unit_volume, DragWeight weight);
void wall_drag_destroy(WallDrag *drag);

/* D unit_volume at x (box's frame, m, inside the box), 1/m2. */
float wall_drag_at(const WallDrag *drag, const float x[3]);

/* The top wall's part of D. If the top wall moves with velocity V, velocities are mirrored about V and the
   friction is -mu_i V_i V0 (D v_i - D_top V). A wall particle behind both the top wall and a wall at rest
   counts for the nearer wall. */
float wall_drag_lid(const WallDrag *drag, const float x[3]);

/* The walls of the box as mirrors: images of the fluid behind each wall; at edges and corners, images of
   images (after Libersky and Petschek, "High strain Lagrangian hydrodynamics", 1993).

   An image has its particle's density, the mirrored velocity, and the particle's pressure. With carried
   density the pressure continues hydrostatically, p' = p + rho0 g.(x' - x). With summed density
   sim/box/walls.h replaces this term, and methods that solve for pressure find a matching pressure.

   |x_i - x_j'| = |x_i' - x_j|: the sum of particle i over images equals the sum of its own images over the
   fluid. Number density with images is a function of positions alone, and the pressure forces without the
   hydrostatic part are its gradient. So walls conserve energy as pairs do, for any arrangement of the
   fluid, and transmit no shear. Friction with images, for slip walls, is friction with mirrored fluid:
   stress along the normal, pure dissipation. The hydrostatic part is along the wall's normal and, on
   average, a function of distance alone: a closed path gains no energy. */

enum { IMAGES_MAX = 27 };

typedef struct WallImage {
    float x[3];    /* m */
    float sign[3]; /* per axis: -1 if mirrored, else 1; for velocities and forces too */
} WallImage;

/* Writes the particle at x (box's frame, m, inside the box), then its images that see fluid within h.
   Returns the number of entries. In a box narrower than h, mutual images of opposite walls are left out. */
int wall_images(const Walls *walls, const float x[3], float h, WallImage image[IMAGES_MAX]);

/* Hydrostatic support by a wall whose images have their particles' pressure. The pressure gradient at such
   a wall is 0; in fluid at rest it is rho0 g. If an image at depth y behind the wall had 2 rho0 g y more
   along the normal, the force on a particle at distance d would gain

     -m g lift(d), lift(d) = V0 sum F x_n 2 y, F = -W'(r) / r, x_n = d + y

   over the lattice behind the wall. For even layers and the kernel (1 - r / h)^3 in three dimensions, lift
   is t^5 (3 - 2 t), t = 1 - d / h. This form is used, scaled to be exact for the first lattice layer; the
   error for further layers is at most 0.02 of a weight. As a function of distance alone, lift is the
   gradient of an energy and heats nothing. Along the wall there is no such part: images of falling
   particles fall too. */

typedef struct WallLift {
    float reach; /* h, m */
    float scale; /* lift at the wall itself */
} WallLift;

/* `lattice` must have the pressure kernel. */
WallLift wall_lift_of(const Lattice *lattice, double spacing, double support_radius);

/* Shares of a particle's weight held by the walls, along each axis; x in the box's frame, m. */
void walls_lift(const WallLift *lift, const Walls *walls, const float x[3], float out[3]);

/* Lift of a single wall at distance d, m, as a sum over the lattice. */
double wall_lift_brute(const Lattice *lattice, double spacing, double support_radius, double d);

#endif
