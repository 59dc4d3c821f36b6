/* The parts of a substep alone, and the machine's peak rates: for `slosh bench --micro`.

   The cost of a part is counted from its loop. A pair is a neighbour in a particle's list; fill entries,
   mirror images and surface tension are not counted. Floats: +, -, *, / and a square root are an operation
   each, comparisons and selections none. Both sides of a selection count; operations per particle do not.
   Bytes: list entries, columns read and written by a pass, and sorted columns come from memory once each
   (`stream`). Data read by a neighbour's index comes from a cache (`gather`). */
#ifndef SLOSH_MICRO_H
#define SLOSH_MICRO_H

#include "sim/world/method.h"
#include "sim/world/world.h"

/* Per pair of a pass: bytes by the neighbour's index, and operations. */
typedef struct PairCost {
    int gather, flops;
} PairCost;

typedef struct MicroPart {
    const char *name;
    const Pass *pass; /* NULL: the sort by cell */
    bool pairs;
    double stream;        /* bytes per particle */
    double stream_a_pair; /* bytes */
    PairCost pair;
} MicroPart;

/* Rate of a copy with a total size of source and target; read bytes and written bytes both count. */
typedef struct CopyCeiling {
    size_t bytes;
    double rate; /* bytes/s */
} CopyCeiling;

/* Rate of a loop of independent a = a m + c in registers. */
typedef struct FlopCeiling {
    int bits;    /* of a register */
    double rate; /* operations/s: two per multiply-add */
} FlopCeiling;

enum { MICRO_PARTS_MAX = 16, MICRO_COPIES_MAX = 10 };

/* Rates of the backend's threads together. */
typedef struct Ceilings {
    int copies; /* from the size of a core's cache to beyond all caches */
    CopyCeiling copy[MICRO_COPIES_MAX];
    FlopCeiling multiply_add; /* as in pair loops: same width, product and sum separate */
    FlopCeiling fused;        /* fused instruction, widest available */
} Ceilings;

/* Additions by a backend. */
typedef struct BackendMicro {
    const Pass *neighbours; /* makes data for walks over neighbours */
    double stream_a_pair;
    double (*grid_stream)(const void *state);
    bool (*pair)(const Pass *pass, const struct Constants *constants, PairCost *cost); /* false: no pairs */
    bool (*ceilings)(const void *state, Ceilings *out); /* false: memory is short */
} BackendMicro;

/* The sort, the neighbour lists and all passes run by the world's method, in a valid order. Returns the
   number of parts; 0: the backend has no separate parts. */
int world_micro_parts(const World *world, MicroPart parts[MICRO_PARTS_MAX]);

/* Runs a part over a time of 0. All parts in order, any number of times, leave the state unchanged, except
   sums of the last step: these are computed again in a different order. */
void world_micro_run(World *world, const MicroPart *part);

/* False if a part was short of memory since the last call: the figures are invalid. */
bool world_micro_sound(World *world);

/* Takes a second or two. Returns false if memory is short or the backend has no ceilings. */
bool world_micro_ceilings(const World *world, Ceilings *out);

#endif
