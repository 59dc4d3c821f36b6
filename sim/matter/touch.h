/* Touching particles of a start, and faces without a neighbour. Particles are volumes of spacing^dimensions;
   a face is shared with a neighbour, closed by a wall or a solid, or open. The graph's Laplacian is the
   continuum's on a lattice, and exact for linear fields on disordered points too. */
#ifndef SLOSH_TOUCH_H
#define SLOSH_TOUCH_H

#include "sim/box/periodic.h"
#include "sim/matter/world_def.h"

typedef struct Touch {
    uint32_t other; /* the neighbour */
    float way[3];   /* to the neighbour, m */
    float weight;   /* 1 / way^2 */
} Touch;

/* Bit 2 k + 1 of `open` is the face towards the greater coordinate along axis k, bit 2 k the opposite
   face. */
typedef struct Touches {
    size_t count;
    size_t *begin; /* count + 1: touches of particle i are at[begin[i]] to before at[begin[i + 1]] */
    Touch *at;     /* each pair twice */
    uint8_t *open;
    uint8_t *solid; /* the same bits for faces closed by a solid; NULL without solids */
    float *gap;     /* 3 per particle with such a face: way to the solid's surface less half a spacing, m;
                       else 0 */
} Touches;

/* Finds the touches of particles at `position` (3 each, m) of a new world with that def. Particles of fluids
   not in `take` touch nothing. Returns false if memory is short; call touches_destroy then too. */
bool touches_create(Touches *touches, const WorldDef *def, const Periodic *periodic, size_t count,
                    const float *position, const uint8_t *fluid, const bool take[FLUIDS_MAX]);
void touches_destroy(Touches *touches); /* a zeroed Touches is allowed */

/* Outward normal of the face of a bit. */
void touch_normal(int bit, double normal[3]);

#endif
