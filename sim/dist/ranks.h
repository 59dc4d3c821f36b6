/* The backend cpu on MPI ranks: each rank makes the same world and calls the same world functions; the
   backend of each rank has a share of the particles. Results equal backend cpu to the bit, for any number
   of ranks and threads. */
#ifndef SLOSH_RANKS_H
#define SLOSH_RANKS_H

#include "sim/world/world_state.h"

struct Backend; /* sim/world/backend.h */

/* Backend name in a def; slosh-dist sets it instead of "cpu". Call backend_add first. world_read gives each
   rank its own particles, ranks_owned of them. */
#define RANKS_BACKEND "ranks"
extern const struct Backend backend_ranks;

/* Work of the process's rank since the last call. */
typedef struct RanksFigures {
    double compute, exchange, balance, wait; /* s: passes; ghosts and moved particles; sharing; waiting for
                                                slower ranks */
    size_t owned, ghosts;                    /* particles now */
    size_t bytes;                            /* memory of the particle state, including ghosts */
    size_t sent, messages;                   /* bytes and messages sent; see dist_sent */
    int balances;                            /* number of times cells changed owners */
} RanksFigures;

/* Figures of the rank, for the last world made. Not collective. */
void ranks_figures(RanksFigures *figures);

/* Number of own particles of the rank in the last world made. */
size_t ranks_owned(void);

/* Writes the cell of each own particle, in the order of world_read. One process orders particles by cell,
   and by id in a cell. The world must have a grid. */
void ranks_cells(uint32_t *cell);

/* Copies the first rank's state to all ranks; `def`: the world's def. Collective. */
void ranks_spread(WorldState *state, const WorldDef *def);

/* True (the default): shares follow the ranks' times. False: the first shares stay. Call before the world
   is made. */
void ranks_balance(bool on);

#endif
