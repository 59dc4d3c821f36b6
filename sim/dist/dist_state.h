/* Inside a Dist: for the files that make it up. */
#ifndef SLOSH_DIST_STATE_H
#define SLOSH_DIST_STATE_H

#include "sim/dist/dist.h"

#include <zoltan.h>
#include <zoltan_comm.h>

/* Which ranks see a cell of this rank: `count` of them from `first` on in Dist.seen. */
typedef struct Seen {
    uint32_t first, count;
} Seen;

/* Cells that have particles, for Zoltan. */
typedef struct Objects {
    const double *weight;
    uint32_t *cell;
    int count;
} Objects;

struct Dist {
    const Constants *constants;
    MPI_Comm comm;
    int rank, size;
    int wide; /* layers of cells whose particles are ghosts */
    struct Zoltan_Struct *zoltan;
    Objects objects;
    int *owner;       /* of each cell */
    uint8_t *foreign; /* of each cell, and of one more: see Cpu.foreign */
    uint8_t *shown;   /* of each cell, and of one more: 1 where other ranks see it */
    uint32_t *border; /* of each cell that they see: its number in `sets` */
    Seen *sets;
    int *seen;
    size_t set_count, set_room, seen_count, seen_room;
    ZOLTAN_COMM_OBJ *plan; /* of the ghosts at hand; NULL: none */
    size_t send_count, ghost_count;
    uint32_t *send_at, *ghost_at; /* where they stand: what others have as ghosts; the ghosts here */
    size_t send_room, ghost_room; /* bytes */
    uint32_t *ranges;             /* of dist_pick */
    size_t ranges_room;
    int *to;        /* ranks that something goes to */
    char *out, *in; /* what goes and what comes */
    size_t to_room, out_room, in_room;
    DistSent sent;
};

/* Places of the fluids' particles that stand in marked cells by Cpu.spare_cell, in order, in Cpu.rank, whose
   values of the last grid are of no use any more; how many. */
size_t dist_pick(Dist *dist, Cpu *cpu, const uint8_t *marked);

/* Ends all ranks where Zoltan failed. */
void dist_check(int code, const char *what);

#endif
