#include "app/probe/probe_window.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Relative tolerance of a row's age: times were written with twelve digits. */
static const double ROUNDING = 1e-9;

void probe_window_free(ProbeWindow *window)
{
    free(window->time);
    free(window->value);
    *window = (ProbeWindow){.columns = window->columns, .longest = window->longest};
}

/* Moves the kept rows to the start of the memory; doubles the memory if more than half full. */
static bool make_room(ProbeWindow *w)
{
    const size_t columns = (size_t)w->columns, room = 2 * w->count >= w->room ? 2 * w->room + 64 : w->room;
    if (w->first > 0) {
        memmove(w->time, w->time + w->first, w->count * sizeof *w->time);
        memmove(w->value, w->value + w->first * columns, w->count * columns * sizeof *w->value);
        w->first = 0;
    }
    if (room == w->room)
        return true;
    double *time = realloc(w->time, room * sizeof *time);
    w->time = time ? time : w->time;
    float *value = realloc(w->value, room * columns * sizeof *value + 1);
    w->value = value ? value : w->value;
    w->room = time && value ? room : w->room;
    return time && value;
}

bool probe_window_add(ProbeWindow *w, double time, const float value[])
{
    if (w->first + w->count == w->room && !make_room(w))
        return false;
    const size_t at = w->first + w->count++;
    w->time[at] = time;
    memcpy(w->value + at * (size_t)w->columns, value, (size_t)w->columns * sizeof *value);
    /* keep one row before the window, as the start of the first interval */
    while (w->count > 2 && w->time[w->first + 1] <= time - w->longest * (1 + ROUNDING)) {
        w->first++;
        w->count--;
    }
    return true;
}

double probe_window_mean(const ProbeWindow *w, int column, double seconds)
{
    const size_t last = w->first + w->count - 1, columns = (size_t)w->columns;
    const double from = w->time[last] - seconds * (1 + ROUNDING);
    double sum = 0, all = 0;
    for (size_t k = last; k > w->first && w->time[k] > from; k--) {
        const double held = fmin(w->time[k] - w->time[k - 1], w->time[k] - from),
                     value = (double)w->value[k * columns + (size_t)column];
        if (!isnan(value)) {
            sum += held * value;
            all += held;
        }
    }
    return all > 0 ? sum / all : (double)w->value[last * columns + (size_t)column];
}
