/* The parts of a substep, each alone, and what the machine could do at most: for `slosh bench --micro`.

   What a part costs is counted as its loop is written. A pair is a neighbour in a particle's list; what fills
   a list up, mirror images and surface tension are left out. Floats: +, -, *, / and a square root are one
   operation each, comparisons and selections none; both sides of a selection count, and nothing that is done
   once a particle. Bytes: an entry of a list, the columns that a pass reads and writes and what the grid
   sorts come from memory once each (`stream`); what is read of a neighbour by its index comes from a cache
   (`gather`). */
#ifndef SLOSH_MICRO_H
#define SLOSH_MICRO_H

#include "sim/world/method.h"
#include "sim/world/world.h"

/* Of a pass, each pair: bytes by the neighbour's index, and operations. */
typedef struct PairCost {
    int gather, flops;
} PairCost;

typedef struct MicroPart {
    const char *name;
    const Pass *pass; /* NULL: the sort by cell */
    bool pairs;
    double stream;        /* bytes a particle */
    double stream_a_pair; /* bytes */
    PairCost pair;
} MicroPart;

/* How fast a copy is whose source and target are as large together; bytes read and bytes written both count.
 */
typedef struct CopyCeiling {
    size_t bytes;
    double rate; /* bytes/s */
} CopyCeiling;

/* Of a loop of independent a = a m + c in registers. */
typedef struct FlopCeiling {
    int bits;    /* of a register */
    double rate; /* operations/s: two each */
} FlopCeiling;

enum { MICRO_PARTS_MAX = 16, MICRO_COPIES_MAX = 10 };

/* What the backend's threads reach together. */
typedef struct Ceilings {
    int copies; /* from what a core's own cache holds to what no cache holds */
    CopyCeiling copy[MICRO_COPIES_MAX];
    FlopCeiling multiply_add; /* as pair loops have it: of their width, a product and a sum */
    FlopCeiling fused;        /* in one instruction, of the widest that the processor has */
} Ceilings;

/* What a backend adds. */
typedef struct BackendMicro {
    const Pass *neighbours; /* makes what walks over neighbours find ready */
    double stream_a_pair;
    double (*grid_stream)(const void *state);
    bool (*pair)(const Pass *pass, const struct Constants *constants, PairCost *cost); /* false: no pairs */
    bool (*ceilings)(const void *state, Ceilings *out); /* false: memory is short */
} BackendMicro;

/* The sort, the lists of neighbours, and all passes that the world's method runs, in an order in which they
   may run; 0: the world's backend has them not apart. */
int world_micro_parts(const World *world, MicroPart parts[MICRO_PARTS_MAX]);

/* Runs a part over a time of 0: all of them, in their order and as often as one likes, leave the state as it
   was, but for sums that it has from the last step: these are made anew in another order. */
void world_micro_run(World *world, const MicroPart *part);

/* False where some of what ran since the last time was short of memory: its figures mean nothing. */
bool world_micro_sound(World *world);

/* Takes a second or two. False when memory is short, or the backend has none. */
bool world_micro_ceilings(const World *world, Ceilings *out);

#endif
