/* Internals of Dist, for the files of sim/dist. */
#ifndef SLOSH_DIST_STATE_H
#define SLOSH_DIST_STATE_H

#include "sim/dist/dist.h"

#include <zoltan.h>
#include <zoltan_comm.h>

/* Ranks that see an own cell: `count` entries of Dist.seen from `first`. */
typedef struct Seen {
    uint32_t first, count;
} Seen;

/* Cells with particles, for Zoltan. */
typedef struct Objects {
    const double *weight;
    uint32_t *cell;
    int count;
} Objects;

struct Dist {
    const Constants *constants;
    MPI_Comm comm;
    int rank, size;
    int wide; /* layers of cells with ghosts */
    struct Zoltan_Struct *zoltan;
    Objects objects;
    int *owner;       /* per cell */
    uint8_t *foreign; /* per cell, plus an extra entry: see Cpu.foreign */
    uint8_t *shown;   /* per cell, plus an extra entry: 1 if foreign ranks see the cell */
    uint32_t *border; /* per shown cell: index in `sets` */
    Seen *sets;
    int *seen;
    size_t set_count, set_room, seen_count, seen_room;
    ZOLTAN_COMM_OBJ *plan; /* of the present ghosts; NULL: none */
    size_t send_count, ghost_count;
    uint32_t *send_at, *ghost_at; /* indices of particles sent as ghosts; of ghosts here */
    size_t send_room, ghost_room; /* bytes */
    uint32_t *ranges;             /* scratch of dist_pick */
    size_t ranges_room;
    int *to;        /* receiving ranks */
    char *out, *in; /* send and receive buffers */
    size_t to_room, out_room, in_room;
    DistSent sent;
};

/* Writes the indices of fluid particles in marked cells (by Cpu.spare_cell) to Cpu.rank, in order. Cpu.rank
   is free: its values belong to the last grid. Returns the number of indices. */
size_t dist_pick(Dist *dist, Cpu *cpu, const uint8_t *marked);

/* Ends all ranks if `code` is a Zoltan error. */
void dist_check(int code, const char *what);

#endif
