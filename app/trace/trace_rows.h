/* Rows that become more than memory may hold: a file without a name, beside the output, as memory. */
#ifndef SLOSH_TRACE_ROWS_H
#define SLOSH_TRACE_ROWS_H

#include "sim/base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise it; `row` is then the size of a row in bytes. */
typedef struct TraceRows {
    void *data; /* count rows; elsewhere after the next is added */
    size_t row; /* bytes */
    size_t count;
    size_t room; /* bytes */
    int file;    /* where there is `data` */
} TraceRows;

/* Adds so many rows, from `rows` (NULL: zeros). False, with the reason and all as it was, where the disk is
   full or memory has no place for them; the file is made as `beside`.XXXXXX and loses its name at once. */
bool trace_rows_add(TraceRows *to, const void *rows, size_t count, const char *beside, Error *error);
void trace_rows_free(TraceRows *rows);

#endif
