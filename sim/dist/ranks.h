/* The backend cpu on MPI ranks: each rank makes the same world and calls the same functions of it, and its
   backend has a share of the particles. To the bit what backend cpu does, whatever the ranks and threads. */
#ifndef SLOSH_RANKS_H
#define SLOSH_RANKS_H

#include "sim/world/world_state.h"

struct Backend; /* sim/world/backend.h */

/* Its name in a def; slosh-dist puts it in the place of "cpu". backend_add it first. Reads of the
   particles (world_read) give each rank its own, ranks_owned of them. */
#define RANKS_BACKEND "ranks"
extern const struct Backend backend_ranks;

/* What the ranks of this process' world did since the last call. */
typedef struct RanksFigures {
    double compute, exchange, balance, wait; /* s: passes; what ghosts and movers take; shares; for others */
    size_t owned, ghosts;                    /* particles now */
    size_t bytes;                            /* memory of the particles' state, ghosts included */
    size_t sent, messages;                   /* bytes to others; see dist_sent */
    int balances;                            /* how often cells changed hands */
} RanksFigures;

/* Of the last world that was made; this rank's own. Not collective. */
void ranks_figures(RanksFigures *figures);

/* Particles that this rank owns in the last world that was made. */
size_t ranks_owned(void);

/* The cell of each of them, in the order in which world_read gives them. In one process they stand by their
   cells, and by their ids in each. Of a world that has a grid. */
void ranks_cells(uint32_t *cell);

/* A state that the first rank has becomes that of all: of the def's worlds. Collective. */
void ranks_spread(WorldState *state, const WorldDef *def);

/* Whether shares follow the time that ranks take (the default), or stay as they began. Before the world. */
void ranks_balance(bool on);

#endif
