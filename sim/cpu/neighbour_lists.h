/* Who the neighbours of each particle are: made once a step, behind the grid, for all passes of that step.

   A list has the indices of all others with r < h in the order of the grid, itself not among them, filled up
   to whole LANES with the index that no particle has (the number of particles). A range of particles has its
   lists in one piece of memory, which the thread that works on the range writes and reads. */
#ifndef SLOSH_NEIGHBOUR_LISTS_H
#define SLOSH_NEIGHBOUR_LISTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    LISTS_GRAIN = 512,         /* particles of a range */
    LISTS_COINCIDENT = 1 << 30 /* in `count`: another one stands where it stands, nearly */
};

typedef struct ListMemory {
    uint32_t *index;
    uint32_t room; /* indices */
} ListMemory;

typedef struct NeighbourLists {
    ListMemory *of_range;
    size_t ranges;
    uint32_t *first; /* of each particle: where in its range's memory its list begins */
    uint32_t *count; /* neighbours in it; LISTS_COINCIDENT besides */
    bool ready;      /* they are those of the last grid */
    bool full;       /* memory was short: some lists lack neighbours; atomic while they are made */
} NeighbourLists;

/* Room for the lists of `particles` with some `neighbours` each; false when memory is short. Adds to *bytes.
 */
bool neighbour_lists_create(NeighbourLists *lists, size_t particles, double neighbours, size_t *bytes);
void neighbour_lists_destroy(NeighbourLists *lists);

/* Room for as many indices in a range's memory, which keeps what it has. False when memory is short: then
   `full` is set. */
bool neighbour_lists_fit(NeighbourLists *lists, size_t range, size_t indices);

#endif
