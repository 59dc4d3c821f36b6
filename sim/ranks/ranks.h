/* Sums and maxima over all ranks. Collective; all ranks get the same bits. */
#ifndef SIM_RANKS_RANKS_H
#define SIM_RANKS_RANKS_H

#include "sim/base/base.h"
#include "sim/cpu/cpu.h"
#include "sim/state.h"

#include <mpi.h>
#include <stddef.h>
#include <stdint.h>

/* Replaces each of `count` sums by the sum over all ranks: the same bits for any distribution of the terms.
   `count`: at most the number of sums felt by box and solids (sim/cpu/cpu.h). */
void reduce_exact(ExactSum *sums, int count);
void reduce_integers(int64_t *numbers, size_t count);

/* Maximum of each value; sum of each value, in doubles, for figures that no step reads; sum of an integer. */
void reduce_most(double *values, int count);
void reduce_sum(double *values, int count);
int64_t reduce_count(int64_t value);

/* Gathers each rank's `count` entries of `size` bytes in the order of the ranks, at `all` on each rank
   where `all` is not NULL. `all` needs room for the entries of all ranks. */
void reduce_gather(const void *own, size_t count, size_t size, void *all);

/* Distribution of the particles over several processes (ranks) that share a world. Zoltan's recursive
   bisection shares out the cells; Zoltan's communication plans move the data. Six operations.

   A cell of the grid belongs to one rank. A rank has its own particles and, as ghosts, all particles of the
   cells next to its own cells. So each rank finds for its own particles what one process would find, in the
   same order. All functions are collective: each rank calls them in the same order. A rank that fails
   prints the reason and ends all ranks (dist_die). */

typedef struct Dist Dist;

/* Call after MPI_Init. `constants` must outlive the Dist. No rank owns a cell yet: call dist_balance next. */
Dist *dist_init(const Constants *constants);

/* Shares the cells out again. `weight`: cost of the particles of each grid cell, 0 for an empty cell. A
   rank reads the weights of its own cells only; with `known` the weights are the same on all ranks. The
   shares stay if all weights are 0, which the first call does not allow. */
void dist_balance(Dist *dist, const double *weight, bool known);

/* Sends particles in foreign cells to the owners of those cells. Call after cpu_cells and without ghosts. */
void dist_migrate(Dist *dist, Cpu *cpu);

/* Brings the ghosts, with cells, for cpu_sort. A ghost has a position, an id and a fluid; the rest is 0. */
void dist_halo(Dist *dist, Cpu *cpu);

/* Call after cpu_sort: updates the indices of the ghosts and of the particles sent as ghosts. */
void dist_follow(Dist *dist, Cpu *cpu);

/* Copies the owners' current values to the ghosts: the rows of cpu->all whose bits are set in `wanted`;
   with `motion` also Cpu.motion. */
void dist_update(Dist *dist, Cpu *cpu, uint64_t wanted, bool motion);

void dist_end(Dist *dist); /* NULL is allowed */

/* ---- queries ---- */

int dist_rank(const Dist *dist);
int dist_size(const Dist *dist);

/* The rank that owns the cell. */
int dist_owner(const Dist *dist, uint32_t cell);

/* As Cpu.foreign; NULL with a single rank. */
const uint8_t *dist_foreign(const Dist *dist);

/* Removes the ghosts; the grid is invalid afterwards. */
void dist_drop(Dist *dist, Cpu *cpu);

/* Number of ghosts present. */
size_t dist_ghosts(const Dist *dist);

/* Data sent by the rank since the last call: moved particles, ghosts and ghost values. Messages of plans
   and of sums over all ranks are not counted. */
typedef struct DistSent {
    size_t bytes, messages;
} DistSent;
DistSent dist_sent(Dist *dist);

/* Prints "slosh-dist: rank N: ..." on standard error and ends all ranks. */
_Noreturn void dist_die(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Makes *memory hold at least `bytes` bytes; *room is the current size in bytes. Old contents are lost.
   Ends all ranks if memory is short. */
void dist_reserve(void *memory, size_t *capacity, size_t bytes);

/* The backend cpu on MPI ranks: each rank makes the same world and calls the same world functions; the
   backend of each rank has a share of the particles. Results equal backend cpu to the bit, for any number
   of ranks and threads. */

struct Backend; /* sim/step/backend.h */

/* Backend name in a def; slosh-dist sets it instead of "cpu". Call backend_add first. world_read gives each
   rank its own particles, world_held of them. */
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

/* Writes the cell of each own particle, in the order of world_read. One process orders particles by cell,
   and by id in a cell. The world must have a grid. */
void ranks_cells(uint32_t *cell);

/* Copies the first rank's state to all ranks; `def`: the world's def. Collective. */
void ranks_spread(WorldState *state, const WorldDef *def);

/* True (the default): shares follow the ranks' times. False: the first shares stay. Call before the world
   is made. */
void ranks_balance(bool on);

#endif
