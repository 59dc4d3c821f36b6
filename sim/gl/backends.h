/* The backends that need GL. */
#ifndef SLOSH_BACKENDS_H
#define SLOSH_BACKENDS_H

#include "sim/base/room.h"
#include "sim/matter/world_def.h"

struct Backend; /* sim/world/backend.h */

extern const struct Backend backend_compute, backend_fragment;

/* The settings of fragment's grid, whose layers hold four particles a cell each. */
typedef struct IN_A_ROOM FragmentDef {
    int grid_layers; /* 0: as many as a lattice needs */
    int lost_limit;  /* so many particles may find no place in the grid in a step */
} FragmentDef;

/* Of fragment's grid, for a world of this def. */
int fragment_layers(const WorldDef *def);

/* Its own settings in a def. */
FragmentDef *fragment_def(const WorldDef *def);

/* Adds them to the list of sim/world/backend.h; before any scene is read. */
void backends_add(void);

#endif
