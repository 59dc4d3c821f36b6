/* Who has which particles where several processes (ranks) share a world, and how they hear of each other:
   Zoltan's recursive bisection of the cells, its communication plans for what moves. Six operations.

   A cell of the grid belongs to one rank. A rank has its own particles and, as ghosts, those of all cells
   next to its own ones: so it finds for its own particles what one process would find, in the same order. All
   functions are collective: each rank calls them in the same order. One rank that fails says why and ends all
   (dist_die). */
#ifndef SLOSH_DIST_H
#define SLOSH_DIST_H

#include "sim/cpu/cpu.h"

#include <mpi.h>

typedef struct Dist Dist;

/* Behind MPI_Init. The cells of `constants`, which outlive it, belong to nobody yet: dist_balance must
 * follow. */
Dist *dist_init(const Constants *constants);

/* Shares the cells anew. `weight`: of each cell of the grid, what its particles cost, 0 for nothing; read
   where the cell is the rank's own, or with `known` the same on all ranks. They stay as they are where all
   are 0, which the first time they may not be. */
void dist_balance(Dist *dist, const double *weight, bool known);

/* Behind cpu_cells: particles that stand in cells of others go there. There are no ghosts before. */
void dist_migrate(Dist *dist, Cpu *cpu);

/* Brings the ghosts, with their cells, for cpu_sort. Of ghosts places, ids and fluids are there, and nothing
 * else. */
void dist_halo(Dist *dist, Cpu *cpu);

/* Behind cpu_sort, which put the ghosts and those that others see in other places. */
void dist_follow(Dist *dist, Cpu *cpu);

/* Ghosts get what their owners have now: of the rows of cpu->all whose bits are wanted; with `motion`
   Cpu.motion too. */
void dist_update(Dist *dist, Cpu *cpu, uint64_t wanted, bool motion);

void dist_end(Dist *dist); /* NULL is allowed */

/* ---- what is asked of it ---- */

int dist_rank(const Dist *dist);
int dist_size(const Dist *dist);

/* Whose cell it is. */
int dist_owner(const Dist *dist, uint32_t cell);

/* As Cpu.foreign has it; NULL where there is one rank. */
const uint8_t *dist_foreign(const Dist *dist);

/* Takes the ghosts out; the grid is then none. */
void dist_drop(Dist *dist, Cpu *cpu);

/* Ghosts at hand. */
size_t dist_ghosts(const Dist *dist);

/* What this rank sent to others since the last call: movers, ghosts and their values. What plans and sums
   over all ranks take is not in it. */
typedef struct DistSent {
    size_t bytes, messages;
} DistSent;
DistSent dist_sent(Dist *dist);

/* Says "slosh-dist: rank N: ..." on standard error and ends all ranks. */
_Noreturn void dist_die(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Memory for count * size bytes or more at *memory, of which *room has count; what was there is lost. */
void dist_reserve(void *memory, size_t *room, size_t bytes);

#endif
