/* Who the neighbours of each particle are: made once a step, behind the grid, for all passes of that step.

   A list has the indices of all others with r < h in the order of the grid, itself not among them. LANES
   particles one behind the other are a group; their lists stand side by side: row k has the k-th neighbour of
   each, and past the end of a list the index that no particle has (the number of particles). A range of
   particles has its lists in one piece of memory, which the thread that works on the range writes and reads.
 */
#ifndef SLOSH_NEIGHBOUR_LISTS_H
#define SLOSH_NEIGHBOUR_LISTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    LANES = 8,                 /* particles that walk their lists side by side: see sim/cpu/simd.h */
    LISTS_GRAIN = 512,         /* particles of a range */
    LISTS_COINCIDENT = 1 << 30 /* in `rows`: another one stands where one of these stands, nearly */
};

typedef struct ListMemory {
    uint32_t *index;
    uint32_t room; /* indices */
} ListMemory;

typedef struct NeighbourLists {
    ListMemory *of_range;
    ListMemory *found; /* by each range: the lists of one group, before they stand side by side */
    size_t ranges;
    uint32_t *first; /* of each group: where in its range's memory its lists begin */
    uint32_t *rows;  /* as many as the longest of its lists has entries; LISTS_COINCIDENT besides */
    ListMemory
        *of_images;   /* by each range: images in the walls and whom they see, see sim/cpu/image_lists.h */
    uint32_t *images; /* of each group: 1 more than where its images begin there; 0: it has none */
    bool ready;       /* they are those of the last grid */
    bool full;        /* memory was short: some lists lack neighbours; atomic while they are made */
} NeighbourLists;

/* Room for the lists of `particles` with some `neighbours` each; false when memory is short. */
bool neighbour_lists_create(NeighbourLists *lists, size_t particles, double neighbours);
void neighbour_lists_destroy(NeighbourLists *lists);

/* What they take now; they grow. */
size_t neighbour_lists_bytes(const NeighbourLists *lists);

/* Room for as many indices in `memory`, a range's, which keeps what it has. False when memory is short: then
   `full` is set. */
bool neighbour_lists_fit(NeighbourLists *lists, ListMemory *memory, size_t indices);

#endif
