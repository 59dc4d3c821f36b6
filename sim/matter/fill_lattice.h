/* The lattice that a fill's particles stand on, and the spacing at which that lattice has the mass of the
   fills.

   Fills that touch or overlap share one lattice. Where one of them is a block, whole layers fit between the
   outermost faces of its blocks: the first stands half a layer from a wall, and the step differs a little
   from axis to axis and from the spacing. A particle stands for spacing^3, so the lattice keeps that volume a
   point: where the steps do not have it, the layers are spread towards a side that touches no wall. Where a
   face between blocks lies within a layer, they share that layer's points by their parts of it. Balls and
   cylinders alone stand on the lattice of the box: half a spacing above the floor, centred between the other
   walls, in whole spacings along a periodic axis. So do blocks that fit it. */
#ifndef SLOSH_FILL_LATTICE_H
#define SLOSH_FILL_LATTICE_H

#include "sim/matter/world_def.h"

/* Layers `begin` to `end` (not among them) may hold points of the fill. */
typedef struct FillAxis {
    double first, step;    /* m: the layer of index i as the fill's faces see it is at first + i * step */
    double place, advance; /* m: its particles are at place + i * advance */
    long begin, end;
} FillAxis;

/* The lattice of a fill of the def. */
void fill_lattice(const WorldDef *def, const Fill *fill, FillAxis axes[3]);

/* Blocks that touch, with a face between them that lies within a layer. */
typedef struct FillPile {
    int dimensions, count;
    const Fill *blocks[FLUIDS_MAX * FILLS_MAX];
    FillAxis axes[3];
} FillPile;

/* The pile that a fill with that lattice is part of; false: there is none. */
bool fill_pile(const WorldDef *def, const Fill *fill, const FillAxis axes[3], FillPile *pile);

/* Whose the point of these layers is: blocks that share its cell have, of such points, as many as their part
   of it. NULL: the pile does not fill the cell, and who holds the point has it. */
const Fill *fill_pile_owner(const FillPile *pile, const long index[3]);

/* The spacing next to the def's at which the largest group of blocks that touch has its volume in particles;
   the def's own where it has it already, and where none within a tenth of it does. */
double fill_lattice_spacing(const WorldDef *def);

/* The same with no search: at which the group keeps the layers that it has at the def's. The steps of the
   axes differ from it by up to the part `uneven`. 0: there it has others. The def's own without blocks. */
double fill_lattice_fit(const WorldDef *def, double *uneven);

#endif
