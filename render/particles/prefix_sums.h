/* Exclusive prefix sums of whole numbers in a buffer, in place: how many of a counting sort stand before each
   cell. By blocks of 1024, whose totals are summed up the same way. */
#ifndef SLOSH_PREFIX_SUMS_H
#define SLOSH_PREFIX_SUMS_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum { PREFIX_SUM_LEVELS = 3 };

/* Zero-initialise it. */
typedef struct PrefixSums {
    unsigned scan, add;                 /* programs */
    unsigned totals[PREFIX_SUM_LEVELS]; /* of the blocks of the level before */
    size_t capacity;                    /* numbers that there is room for */
} PrefixSums;

/* False when a shader does not compile; prefix_sums_destroy is needed in either case. */
bool prefix_sums_create(PrefixSums *sums, Error *error);
void prefix_sums_destroy(PrefixSums *sums);

/* Of the first `size` numbers, at most 2^30. Binds the storage of shaders/shared/scan.h. */
void prefix_sums_run(PrefixSums *sums, unsigned buffer, size_t size);

#endif
