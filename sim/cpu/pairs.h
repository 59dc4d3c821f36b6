/* Neighbour lists of all particles: made once per step, after the grid, for all passes of the step.

   A list has the indices of all particles with r < h in grid order, without the particle itself. LANES
   particles in sequence are a group, with interleaved lists: row k has the k-th neighbour of each particle.
   An entry is twice an index (f8_gather of sim/base/simd.h). Entries past a list's end are those of the dummy
   particle, after all particles and copies. The lists
   of a range of particles are in the range's own memory, written and read by the range's thread. */
#ifndef SIM_CPU_PAIRS_H
#define SIM_CPU_PAIRS_H

#include "sim/base/base.h"
#include "sim/box/box.h"
#include "sim/error.h"
#include "sim/state.h"
#include "sim/step/backend.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    LISTS_GRAIN = 512,          /* particles per range */
    LISTS_COINCIDENT = 1 << 30, /* in `rows`: some particle of the group nearly coincides with a neighbour */
    LISTS_SOLID =
        1 << 29, /* in `rows`: some particle of the group may have a boundary particle as neighbour */
    LISTS_FLAGS = LISTS_COINCIDENT | LISTS_SOLID,
};

typedef struct ListMemory {
    uint32_t *index;   /* entries of lists */
    uint32_t capacity; /* entries */
} ListMemory;

/* The entry of a particle, and the particle of an entry. */
static inline uint32_t list_entry(size_t particle)
{
    return 2 * (uint32_t)particle;
}

static inline size_t list_particle(uint32_t entry)
{
    return entry / 2;
}

typedef struct NeighbourLists {
    ListMemory *of_range;
    ListMemory *found; /* per range: the lists of a group, before interleaving */
    size_t ranges;
    uint32_t *first;       /* per group: begin of its lists in the range's memory */
    uint32_t *rows;        /* per group: length of the longest list, plus LISTS_FLAGS */
    ListMemory *of_images; /* per range: wall images and their neighbours, see sim/cpu/pair_loop.h */
    uint32_t *images;      /* per group: 1 + begin of its images; 0: no images */
    bool ready;            /* lists match the last grid */
    bool full;             /* memory was short: some lists are incomplete; atomic while lists are made */
} NeighbourLists;

/* Current size in bytes; the lists can grow. */
size_t neighbour_lists_bytes(const NeighbourLists *lists);

/* Makes room for `indices` entries in `memory` of a range and keeps the contents. Returns false and sets
   `full` if memory is short. */
bool neighbour_lists_fit(NeighbourLists *lists, ListMemory *memory, size_t indices);

/* Inputs and outputs of sums over neighbours, the loops that take most of the time. */

/* Position of the dummy particle that fills up lists, m; its square is finite. */
#define PAST 1e9F

/* Arrays of particles sorted by cell; readable for LANES - 1 entries past the last. */
typedef struct PairArgs {
    const Constants *constants;
    size_t count;  /* particles */
    uint32_t none; /* index of the dummy particle: after the particles and copies */
    const CellFold *fold;
    const uint32_t *cell_start; /* first particle of each place of `fold`; places + 1 */
    const uint32_t *copy_start; /* first copy outside of the box (sim/cpu/boundary.c) per place, counted from
                                   `count`; places + 1; NULL: no periodic sides */
    const uint32_t *cell;       /* per particle */
    const uint8_t *foreign;     /* per cell: 1 if its particles are ghosts, without lists; NULL */
    const ParticleId *id;
    const uint8_t *fluid;
    const float *x, *y, *z, *vx, *vy, *vz; /* m, m/s */
    const float (*place)[4];               /* per particle {x, y, z, p V^2}; after the last {PAST, ...} */
    const float (*motion)[4];              /* {vx, vy, vz, V}; after the last 0 */
    NeighbourLists *lists;
    const float *volume;            /* over Constants.unit_volume: set before forces */
    const float *pressure_term;     /* p V^2, Pa: set before forces */
    const float *viscosity;         /* Pa s, per particle; NULL with a single fluid */
    const float *kind;              /* fluid number per particle; NULL if unused */
    const float *tension;           /* Constants.tension per particle; NULL: none; requires `kind` */
    const ApparentGravity *gravity; /* for passes that use gravity */
    float *fx, *fy, *fz;            /* out of forces, N/m3; `fx` also of rates */
    float *number_density;   /* out of densities, times Constants.unit_volume: in the place of `volume` */
    float *own[COLUMNS_OWN]; /* columns of the method */
    float *const *term;      /* columns shared by methods */
} PairArgs;

/* Instruction sets of the pair loops in files NAME/pairs*.c. The best set for the processor is chosen when
   a world is made. All sets give the same bits. */

typedef enum PairSet { PAIR_BASELINE, PAIR_AVX2, PAIR_SETS } PairSet;

/* Sums for the particles [begin, end). */
typedef void PairLoop(const PairArgs *args, size_t begin, size_t end);

/* A loop in all sets. */
typedef struct PairLoops {
    PairLoop *in[PAIR_SETS];
} PairLoops;

/* PAIR_LOOPS(name): declares the loop defined by PAIR_LOOP(name) in a file NAME/pairs*.c. */
#if defined(__x86_64__)
#define PAIR_LOOPS(name)                                                                                     \
    PairLoop name##_baseline, name##_avx2;                                                                   \
    static const PairLoops name = {{name##_baseline, name##_avx2}}
#else
#define PAIR_LOOPS(name)                                                                                     \
    PairLoop name##_baseline;                                                                                \
    static const PairLoops name = {{name##_baseline}}
#endif

/* Values of solver.simd, ended by a NULL name; the first value takes the widest set of the processor. */
typedef struct SimdKind {
    const char *name, *help;
} SimdKind;

extern const SimdKind simd_kinds[];

/* Chooses the set for entry `simd` of simd_kinds. Entry 0 takes the set named by the environment variable
   SLOSH_SIMD if the processor has the set (for tests of the whole program), otherwise the widest set.
   Returns false, with the reason, if the choice is impossible. */
bool pair_set_choose(int simd, PairSet *set, Error *error);

/* The set's name in simd_kinds. */
const char *pair_set_name(PairSet set);

#endif
