/* Which particles of a start touch, and where they touch nothing: volumes of spacing^dimensions whose faces
   are shared with a neighbour, closed by a wall or a solid, or open. A graph whose Laplacian is the
   continuum's on a lattice, and exact for linear fields on points out of order too. */
#ifndef SLOSH_TOUCH_H
#define SLOSH_TOUCH_H

#include "sim/box/periodic.h"
#include "sim/matter/world_def.h"

typedef struct Touch {
    uint32_t other; /* the neighbour */
    float way[3];   /* to it, m */
    float weight;   /* 1 / way^2 */
} Touch;

/* Bit 2 k + 1 of `open` is the face towards the greater coordinate along axis k, bit 2 k the one opposite. */
typedef struct Touches {
    size_t count;
    size_t *begin; /* count + 1: those of particle i are at[begin[i]] to before at[begin[i + 1]] */
    Touch *at;     /* each pair twice */
    uint8_t *open;
    uint8_t *solid; /* such bits of the faces that a solid closes; NULL without solids */
    float *gap;     /* 3 a particle that has some: the way to the solid's surface less half a spacing, m */
} Touches;

/* Of particles at `position` (3 each) of a new world with that def. Those of fluids that do not `take` part
   touch nothing. False when memory is short. */
bool touches_create(Touches *touches, const WorldDef *def, const Periodic *periodic, size_t count,
                    const float *position, const uint8_t *fluid, const bool take[FLUIDS_MAX]);
void touches_destroy(Touches *touches); /* a zeroed one is allowed */

/* Outward, of the face of a bit. */
void touch_normal(int bit, double normal[3]);

#endif
