/* Exclusive prefix sums of integers in a buffer, in place: for a counting sort, the number of items before
   each cell. Works by blocks of 1024; the totals of the blocks are summed the same way. */
#ifndef SLOSH_PREFIX_SUMS_H
#define SLOSH_PREFIX_SUMS_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum { PREFIX_SUM_LEVELS = 3 };

/* Zero-initialise. */
typedef struct PrefixSums {
    unsigned scan, add;                 /* programs */
    unsigned totals[PREFIX_SUM_LEVELS]; /* buffers: totals of the blocks of each level */
    size_t capacity;                    /* capacity in numbers */
} PrefixSums;

/* Returns false if a shader does not compile; call prefix_sums_destroy in either case. */
bool prefix_sums_create(PrefixSums *sums, Error *error);
void prefix_sums_destroy(PrefixSums *sums);

/* Sums the first `size` numbers, at most 2^30. Binds the storage of shaders/shared/scan.h. */
void prefix_sums_run(PrefixSums *sums, unsigned buffer, size_t size);

#endif
