/* Rows in a growing memory map of an unnamed file beside the output, as they may exceed the memory. */
#ifndef SLOSH_TRACE_ROWS_H
#define SLOSH_TRACE_ROWS_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise, then set `row`. */
typedef struct TraceRows {
    void *data; /* `count` rows; moves when rows are added */
    size_t row; /* bytes */
    size_t count;
    size_t room; /* bytes */
    int file;    /* file descriptor, if `data` is not NULL */
} TraceRows;

/* Adds `count` rows from `rows` (NULL: zeros). Returns false with the reason, and all rows unchanged, if
   the disk is full or address space is short. The file is made as `beside`.XXXXXX and unlinked at once. */
bool trace_rows_add(TraceRows *to, const void *rows, size_t count, const char *beside, Error *error);
void trace_rows_free(TraceRows *rows);

#endif
