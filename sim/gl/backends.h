/* Backends that need GL. */
#ifndef SLOSH_BACKENDS_H
#define SLOSH_BACKENDS_H

#include "sim/base/room.h"
#include "sim/matter/world_def.h"

struct Backend; /* sim/world/backend.h */

extern const struct Backend backend_compute, backend_fragment;

/* Settings of fragment's grid, whose layers hold four particles per cell. */
typedef struct IN_A_ROOM FragmentDef {
    int grid_layers; /* 0: as many as a lattice needs */
    int lost_limit;  /* most particles without a place in the grid, per step */
} FragmentDef;

/* Layers of fragment's grid for a world of the def. */
int fragment_layers(const WorldDef *def);

/* The settings of backend fragment in a def. */
FragmentDef *fragment_def(const WorldDef *def);

/* Adds the GL backends to the list of sim/world/backend.h; call before any scene is read. */
void backends_add(void);

#endif
