/* Neighbour lists of all particles: made once per step, after the grid, for all passes of the step.

   A list has the indices of all particles with r < h in grid order, without the particle itself. LANES
   particles in sequence are a group, with interleaved lists: row k has the k-th neighbour of each particle.
   Entries past a list's end hold the index of the dummy particle, after all particles and copies. The lists
   of a range of particles are in the range's own memory, written and read by the range's thread. */
#ifndef SLOSH_NEIGHBOUR_LISTS_H
#define SLOSH_NEIGHBOUR_LISTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    LANES = 8,                 /* particles that walk side by side: see sim/cpu/simd.h */
    LISTS_GRAIN = 512,         /* particles per range */
    LISTS_COINCIDENT = 1 << 30 /* in `rows`: some particle of the group nearly coincides with a neighbour */
};

typedef struct ListMemory {
    uint32_t *index;
    uint32_t room; /* indices */
} ListMemory;

typedef struct NeighbourLists {
    ListMemory *of_range;
    ListMemory *found; /* per range: the lists of a group, before interleaving */
    size_t ranges;
    uint32_t *first;       /* per group: begin of its lists in the range's memory */
    uint32_t *rows;        /* per group: length of the longest list, plus LISTS_COINCIDENT */
    ListMemory *of_images; /* per range: wall images and their neighbours, see sim/cpu/image_lists.h */
    uint32_t *images;      /* per group: 1 + begin of its images; 0: no images */
    bool ready;            /* lists match the last grid */
    bool full;             /* memory was short: some lists are incomplete; atomic while lists are made */
} NeighbourLists;

/* Makes room for lists of `particles` particles with about `neighbours` neighbours each. Returns false if
   memory is short. */
bool neighbour_lists_create(NeighbourLists *lists, size_t particles, double neighbours);
void neighbour_lists_destroy(NeighbourLists *lists);

/* Current size in bytes; the lists can grow. */
size_t neighbour_lists_bytes(const NeighbourLists *lists);

/* Makes room for `indices` indices in `memory` of a range and keeps the contents. Returns false and sets
   `full` if memory is short. */
bool neighbour_lists_fit(NeighbourLists *lists, ListMemory *memory, size_t indices);

#endif
