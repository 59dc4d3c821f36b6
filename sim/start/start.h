/* The initial state: from the fills of a def to particles, their order around solids, and a start in
   balance. */
#ifndef SIM_START_START_H
#define SIM_START_START_H

#include "sim/def.h"
#include "sim/flow/flow.h"
#include "sim/kernel/kernel.h"
#include "sim/solids/solid.h"

/* The initial state: the fills of a def become particles, each fill on its lattice.
   A lattice is half a layer from touching walls and in line with touching fills, so fluids never overlap.
   Where fills overlap, the first fill of the first fluid gets the point. No point is within half a spacing of
   a solid. */

/* Writes position (3 each, m) and fluid of every lattice point in a fill, fill by fill, and returns the
   number of points. The order in a fill is z, y, x (x fastest). With NULLs only counts. */
size_t seed_lattice(const WorldDef *def, float *position, uint8_t *fluid);

/* Number of particles in the fills at `spacing` (m); SIZE_MAX if more than 2^32 or if the box has more than
   10^7 spacings along an axis. Walks the lattice points of each fill, allocates nothing. A bowl's thickness
   of 0 stands for the support radius. */
size_t seed_count(const WorldDef *def, double spacing);

/* Number of particles of each fluid, at the def's spacing. */
void seed_counts(const WorldDef *def, size_t counts[FLUIDS_MAX]);

/* True if a fill's height by formula or table is not finite over a point of the fill; writes the first such
   fill, and x and z (m) of the point to `at`. */
bool seed_lacks_height(const WorldDef *def, int *fluid, int *index, double at[2]);

/* Moves each of `count` points by up to WorldDef.jitter spacings along each axis, the same way in each run;
   walls are no limit. */
void seed_jitter(const WorldDef *def, float *position, size_t count);

/* Greatest fall of fluid, which bounds its depth. */

/* Distance from the highest start or emitter of the def's fluids, against gravity, down to the end of the
   box, m; 0 without fluid or gravity. */
double greatest_fall(const WorldDef *def);

/* The vortices of G. I. Taylor and A. E. Green, "Mechanism of the production of small eddies from large
   ones", 1937, in the plane: an exact solution, decaying as exp(-nu (kx^2 + ky^2) t), kx = 2 pi / width, ky =
   2 pi / height,

     u = -U cos(kx x) sin(ky y),  v = U (kx / ky) sin(kx x) cos(ky y),
     p = -rho U^2 / 4 (cos(2 kx x) + (kx / ky)^2 cos(2 ky y)),

   in the box's frame, two by two vortices in the box. */

/* Adds the velocity of the fluid's vortices at x (m) to v (m/s); returns their pressure, Pa. */
double vortices_add(const WorldDef *def, const FluidDef *fluid, const float x[3], float v[3]);

/* True if some fluid starts with vortices. */
bool vortices_any(const WorldDef *def);

/* The region of a fill, a drain or a guide. */

/* True if x (m) is in the region. Both faces of a block are shifted down by `tolerance` (m): a point so near
   outside the low side is in. A point so near inside the high side is not. */
bool fill_holds(const Fill *fill, int dimensions, const double x[3], double tolerance);

/* True if the fill ends at a height by formula or table; writes the height at x and z to *y, m. */
bool fill_ends(const Fill *fill, double x, double z, double *y);

/* Corners of the smallest block around the fill with faces along the axes, m; in two dimensions a ball has a
   z range too. */
void fill_bounds(const Fill *fill, double low[3], double high[3]);

/* Volume of the fill without regard to `below`, m3; in two dimensions area, m2. */
double fill_volume(const Fill *fill, int dimensions);

/* The lattice of a fill's particles, and the spacing at which the lattice has the mass of the fills.

   Fills that touch or overlap share one lattice. If the fills include a block, whole layers fit between the
   outermost faces of the blocks. The first layer is half a layer from a wall, and the step differs a little
   from axis to axis and from the spacing. A particle stands for spacing^3, so the lattice keeps that volume
   per point: where the steps give another volume, the layers are spread towards a side without a wall. Where
   a face between blocks lies within a layer, the blocks share that layer's points by their parts of the
   layer.

   Balls, cylinders and meshes alone use the lattice of the box: half a spacing above the floor, centred
   between the other walls, in whole spacings along a periodic axis. So do blocks that fit the lattice of the
   box. */

/* Layers from `begin` to before `end` may hold points of the fill. */
typedef struct FillAxis {
    double first, step;    /* m: layer i for tests against the fill's faces is at first + i * step */
    double place, advance; /* m: particles of layer i are at place + i * advance */
    long begin, end;
} FillAxis;

enum { FILLS_ALL = FLUIDS_MAX * FILLS_MAX };

/* The groups of fills that touch, directly or through others. Fills are numbered through all fluids. */
typedef struct FillGroups {
    int count;                   /* of fills */
    const Fill *fill[FILLS_ALL]; /* by number */
    int group[FILLS_ALL];        /* of each fill: the first fill of the group */
    bool pile[FILLS_ALL];        /* of a group's first fill: the group has only blocks, without overlaps */
} FillGroups;

/* Makes the groups of a def; the work goes by the square of the number of fills. */
void fill_groups(const WorldDef *def, FillGroups *groups);

/* Writes the lattice of a fill of the def. */
void fill_lattice(const WorldDef *def, const FillGroups *groups, int fill, FillAxis axes[3]);

/* Blocks that touch, with a face between two blocks within a layer. */
typedef struct FillPile {
    int dimensions, count;
    FillAxis axes[3];
    const Fill *blocks[FILLS_ALL];
} FillPile;

/* Writes the pile of a fill with lattice `axes`; false if the fill is in no pile. */
bool fill_pile(const WorldDef *def, const FillGroups *groups, int fill, const FillAxis axes[3],
               FillPile *pile);

/* The block that owns the point of layers `index`. Blocks that share a cell own such points in proportion to
   their parts of the cell. NULL if the pile does not fill the cell: the first fill that covers the point owns
   it. */
const Fill *fill_pile_owner(const FillPile *pile, const long index[3]);

/* The spacing nearest to the def's at which the largest group of touching blocks has its volume in particles.
   Returns the def's spacing if it fits already, or if no spacing within 10 % fits. */
double fill_lattice_spacing(const WorldDef *def);

/* The same without a search: the spacing at which the group keeps the layers that the group has at the def's
   spacing. Writes the greatest relative difference of a step from the result to *uneven. Returns 0 if the
   layers change at the result, and the def's spacing without blocks. */
double fill_lattice_fit(const WorldDef *def, double *uneven);

/* An order of particles at the start around solids, stable under an even pressure.

   after: A. Colagrossi, B. Bouscasse, M. Antuono, S. Marrone, "Particle packing algorithm for SPH schemes",
   2012

   Next to a round solid the lattice is cut, and the fluid finds an order there in the first moments. A method
   with carried density takes the motion for compression, and without diffusion keeps the error: pressure next
   to a disc stays 7 % of rho0 g H too high. */

typedef struct Packing {
    const WorldDef *def;
    const Lattice *lattice;
    const Boundary *boundary;
    const bool *take; /* FLUIDS_MAX: fluids with particles to move */
} Packing;

/* Moves particles of the fluids in `take`, at `position` (3 each, m), within a support radius of a solid.
   They move down the gradient of the number density of all particles, and into no solid. Particles near a
   surface, a wall or a periodic side stay, like all without neighbours all around. Returns false if memory is
   short. */
bool packing_settle(const Packing *packing, size_t count, const uint8_t *fluid, float *position);

/* A start in balance: the pressure with which gravity does not compress resting fluid in the first moment,
   and positions with the densities of that pressure.

   div(grad p / rho - g) = 0, p = 0 at free surfaces, no flow through walls. Resting fluid gets hydrostatic
   pressure, in layers too; freely falling fluid gets none; a dam gets the pressure with which the dam begins
   to collapse. */

/* Greatest number of particles for a balanced start: worlds with more start at rest density. A million take
   some 15 s of processor time. */
enum { BALANCE_MOST = 2000000 };

typedef struct Balance {
    Touches touches;
    const uint8_t *fluid;
    double density[FLUIDS_MAX]; /* rho0 per fluid, kg/m3 */
    double spacing;             /* m */
    uint32_t *order;            /* particles, sorted by connected parts */
    uint32_t *part_begin;       /* index in `order` where each part begins, and the end of the last */
    size_t parts;
    double *work;                 /* for the solver */
    double *open_weight, *weight; /* of the equations, per particle and per touch */
    uint32_t *other;              /* neighbour of each touch, in an array without gaps */
} Balance;

/* Arguments as for touches_create. Returns false if memory is short. */
bool balance_create(Balance *balance, const WorldDef *def, const Periodic *periodic, size_t count,
                    const float *position, const uint8_t *fluid, const bool take[FLUIDS_MAX]);
void balance_destroy(Balance *balance);

/* Writes each particle's pressure, Pa, under `gravity` (m/s2, the box's frame). In a part with no free
   surface, pressure is 0 at the top. */
void balance_pressure(Balance *balance, const double gravity[3], const float *position, float *pressure);

/* Moves particles to positions with the given compression, rho / rho0 - 1. A part with no free surface sinks
   from the lid if gravity is along an axis and the world has no solids; else the part keeps its volume. */
void balance_move(Balance *balance, const double gravity[3], const double *compression, float *position);

/* Moves lattice particles, by a flow without compression, into the gaps that the lattice leaves next to
   solids: the free surface sinks by the missing volume. The balance is invalid afterwards. */
void balance_fit(Balance *balance, float *position);

/* Heights at which fluids end. */
typedef struct BalanceSurface {
    /* Surface height of that fluid at x and z, m; false: no particular height. */
    bool (*height)(const void *context, int fluid, double x, double z, double *y);
    const void *context;
} BalanceSurface;

/* Moves lattice particles, by a flow without compression, so that the lattice's steps at a surface follow the
   surface. The mean height of the surface above the steps stays. The balance is invalid afterwards. Returns
   false if memory is short. */
bool balance_raise(Balance *balance, const BalanceSurface *surface, float *position);

#endif
