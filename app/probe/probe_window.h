/* Means over the last seconds, from earlier rows. */
#ifndef SLOSH_PROBE_WINDOW_H
#define SLOSH_PROBE_WINDOW_H

#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise all but `columns` and `longest`. */
typedef struct ProbeWindow {
    int columns;
    double longest;            /* s: how long rows are kept */
    size_t first, count, room; /* kept rows and capacity */
    double *time;              /* s, */
    float *value;              /* `columns` per row */
} ProbeWindow;

/* Adds a row, later than the last; returns false if memory is short. */
bool probe_window_add(ProbeWindow *window, double time, const float value[]);
void probe_window_free(ProbeWindow *window);

/* Returns the mean of a column over the last `seconds` up to the last row. Each row stands for the time
   since the row before; NaN is skipped. Without an earlier row, returns the last row's value. */
double probe_window_mean(const ProbeWindow *window, int column, double seconds);

#endif
