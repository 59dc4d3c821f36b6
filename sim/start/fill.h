/* The region of a fill, a drain or a guide. */
#ifndef SIM_START_FILL_H
#define SIM_START_FILL_H

#include "slosh/def.h"

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

/* Writes the lattice of a fill of the def. */
void fill_lattice(const WorldDef *def, const Fill *fill, FillAxis axes[3]);

/* Blocks that touch, with a face between two blocks within a layer. */
typedef struct FillPile {
    int dimensions, count;
    const Fill *blocks[FLUIDS_MAX * FILLS_MAX];
    FillAxis axes[3];
} FillPile;

/* Writes the pile of a fill with lattice `axes`; false if the fill is in no pile. */
bool fill_pile(const WorldDef *def, const Fill *fill, const FillAxis axes[3], FillPile *pile);

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

#endif
