/* Means over the last seconds, from the rows before. */
#ifndef SLOSH_PROBE_WINDOW_H
#define SLOSH_PROBE_WINDOW_H

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise it but for `columns` and `longest`. */
typedef struct ProbeWindow {
    int columns;
    double longest;            /* s: rows are kept for so long */
    size_t first, count, room; /* of the rows that are kept, and that there is memory for */
    double *time;              /* s, */
    float *value;              /* `columns` a row */
} ProbeWindow;

/* Adds a row, later than the last; false when memory is short. */
bool probe_window_add(ProbeWindow *window, double time, const float value[]);
void probe_window_free(ProbeWindow *window);

/* The mean of a column over the last `seconds` up to the last row: each row holds from the one before; NaN
   counts nowhere. The last row's own value where there is no earlier one. */
double probe_window_mean(const ProbeWindow *window, int column, double seconds);

#endif
