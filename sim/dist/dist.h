/* Distribution of the particles over several processes (ranks) that share a world. Zoltan's recursive
   bisection shares out the cells; Zoltan's communication plans move the data. Six operations.

   A cell of the grid belongs to one rank. A rank has its own particles and, as ghosts, all particles of the
   cells next to its own cells. So each rank finds for its own particles what one process would find, in the
   same order. All functions are collective: each rank calls them in the same order. A rank that fails
   prints the reason and ends all ranks (dist_die). */
#ifndef SLOSH_DIST_H
#define SLOSH_DIST_H

#include "sim/cpu/cpu.h"

#include <mpi.h>

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
void dist_reserve(void *memory, size_t *room, size_t bytes);

#endif
