/* The box: its motion as a map of positions and velocities, periodic sides, and walls. */
#ifndef SIM_BOX_BOX_H
#define SIM_BOX_BOX_H

#include "shaders/sim/box/wall_cushion_part.h"
#include "sim/def.h"
#include "sim/kernel/kernel.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* Positions in wide boxes. A step adds v dt in single precision, and increments below half of the last
   digit are lost. In a box 400 spacings wide the loss is 1e-5 spacings per half step, so slow fluid stands
   still. In wide boxes a particle keeps the rounding remainder of its position (column `remainder`), and
   the next step adds the remainder.

   A position relative to the cell would keep as many digits, but then pair sums, walls, views and files
   would need the cell. Instead they read the rounded position, and only the stepping knows the remainder.

   After: W. Kahan, "Further remarks on reducing truncation errors", 1965; the sum without comparison is
   from D. E. Knuth, "The Art of Computer Programming", vol. 2, sec. 4.2.2. */

#ifdef __FAST_MATH__
#error "what rounding leaves is 0 under -ffast-math"
#endif

/* Adds `way` to a coordinate, m. `left`: rounding remainder so far, at most half of the last digit; NULL:
   remainders are lost. */
static inline void place_move(float *x, float *left, float way)
{
    if (!left) {
        *x += way;
        return;
    }
    const float sum = *x + way, added = sum - *x;
    const float all = *left + ((*x - (sum - added)) + (way - added));
    *x = sum + all;
    *left = all - (*x - sum);
}

/* For a position set explicitly: clears the remainder of changed coordinates. */
static inline void place_put(const float before[3], const float x[3], float left[3])
{
    for (int k = 0; left && k < 3; k++)
        left[k] = x[k] == before[k] ? left[k] : 0;
}

/* From a pose of the box to the next: maps a free particle's position and velocity in the box's frame. The
   map is straight flight in the world, seen from both poses: changes of the box's velocity and rotation are
   exact, Coriolis is a rotation, and no acceleration is sampled. So nothing drifts. */

/* With D = R1^T R0 - I, x1 = (I + D) (x0 + (v0 + omega0 x x0) dt - shift),
   v1 = (I + D) (v0 + omega0 x x0) - velocity_change - omega1 x x1.
   D is kept apart from I, since near-identity rotations rounded to float would shrink or grow the fluid. */
typedef struct BoxStep {
    bool still;                     /* the box does not move: x1 = x0 + v0 dt */
    float dt;                       /* s */
    float rotation[3][3];           /* D */
    float omega0[3];                /* angular velocity at the begin, in the axes of the begin, rad/s */
    float omega1[3];                /* at the end, in the axes of the end */
    float shift[3];                 /* P1 - P0 - V0 dt of the box's origin, in the axes of the begin, m */
    float velocity_change[3];       /* V1 - V0 of the box's origin, in the axes of the end, m/s */
    const struct SolidStep *solids; /* steps of the solids; NULL without solids */
} BoxStep;

void box_step(const BoxState *begin, const BoxState *end, double dt, BoxStep *step);

/* Apparent gravity of a body at rest in the box, in the box's axes of `middle`, from velocities at both
   ends of a step: gravity minus the box's acceleration. At x: origin - alpha x x - omega x (omega x x). */
typedef struct ApparentGravity {
    float origin[3]; /* m/s2 */
    float alpha[3];  /* rad/s2 */
    float omega[3];  /* rad/s */
} ApparentGravity;

void apparent_gravity(const double gravity[3], const BoxState *begin, const BoxState *middle,
                      const BoxState *end, double dt, ApparentGravity *out);

static inline void box_cross(const float a[3], const float b[3], float out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Applies the step to a particle. `left`: rounding remainder of the position, or NULL.
 */
static inline void box_advance(const BoxStep *step, float x[3], float left[3], float v[3])
{
    if (step->still) {
        for (int k = 0; k < 3; k++)
            place_move(&x[k], left ? &left[k] : NULL, v[k] * step->dt);
        return;
    }
    float swirl[3], w[3], y[3];
    box_cross(step->omega0, x, swirl);
    for (int k = 0; k < 3; k++) {
        w[k] = v[k] + swirl[k];
        y[k] = x[k];
        place_move(&y[k], left ? &left[k] : NULL, w[k] * step->dt - step->shift[k]);
    }
    for (int k = 0; k < 3; k++) {
        x[k] = y[k];
        place_move(&x[k], left ? &left[k] : NULL,
                   step->rotation[k][0] * y[0] + step->rotation[k][1] * y[1] + step->rotation[k][2] * y[2]);
    }
    box_cross(step->omega1, x, swirl);
    for (int k = 0; k < 3; k++)
        v[k] = w[k] +
               (step->rotation[k][0] * w[0] + step->rotation[k][1] * w[1] + step->rotation[k][2] * w[2]) -
               step->velocity_change[k] - swirl[k];
}

/* The apparent gravity at x. */
static inline void apparent_gravity_at(const ApparentGravity *gravity, const float x[3], float out[3])
{
    float euler[3], inner[3], outer[3];
    box_cross(gravity->alpha, x, euler);
    box_cross(gravity->omega, x, inner);
    box_cross(gravity->omega, inner, outer);
    for (int k = 0; k < 3; k++)
        out[k] = gravity->origin[k] - euler[k] - outer[k];
}

/* Periodic sides: particles that leave there enter on the opposite side, and neighbours see each other
   across. After: M. P. Allen, D. J. Tildesley, "Computer Simulation of Liquids", 1987, sec. 1.5.2.
   Positions stay in [low, low + size], up to single-precision rounding (on cpu from the end of a step on).
   Along a periodic axis the box is at least two support radii wide, so that no particle sees a neighbour
   twice. */

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
   comes from images of the fluid (below). */

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
   g, m/s2, over a step dt (s). The spring is weaker if the step is too long for it, and adds nothing for dt =
   0. */
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
   the hydrostatic support below replaces this term, and methods that solve for pressure find a matching
   pressure.

   |x_i - x_j'| = |x_i' - x_j|: the sum of particle i over images equals the sum of its own images over the
   fluid. Number density with images is a function of positions alone, and the pressure forces without the
   hydrostatic part are its gradient. So walls conserve energy as pairs do, for any arrangement of the
   fluid, and transmit no shear. Friction with images, for slip walls, is friction with mirrored fluid:
   stress along the normal, pure dissipation. The hydrostatic part is along the wall's normal and, on average,
   a function of distance alone, so a closed path gains no energy. */

enum { IMAGES_MAX = 27 };

typedef struct WallImage {
    float x[3];    /* m */
    float sign[3]; /* per axis: -1 if mirrored, else 1; for velocities and forces too */
} WallImage;

/* For tests of lists of images, by brute force: writes the particle at x (box's frame, m, inside the box),
   then its images that see fluid within h.
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

#endif
