#include "app/scaling/series.h"

#include <math.h>
#include <stdbool.h>

const char *const series_names[SERIES_KINDS] = {"strong", "weak"};

/* Greatest relative difference of size from the first run of a series. */
static const double alike[SERIES_KINDS] = {0.02, 0.15};

/* Returns the size shared by the runs of a series. */
static double size_of(const SeriesRun *run, SeriesKind kind)
{
    return kind == SERIES_STRONG ? run->cost.particles : run->cost.particles / run->cost.ranks;
}

/* Adds a run if its ranks are new to the series, or if the run is faster than the present run with these
   ranks. */
static void take(const SeriesRun *runs, Series *series, int run)
{
    int at = 0;
    const CostSample *cost = &runs[run].cost;
    while (at < series->count && runs[series->run[at]].cost.ranks < cost->ranks)
        at++;
    if (at < series->count && runs[series->run[at]].cost.ranks == cost->ranks) {
        if (runs[run].step / cost->particles <
            runs[series->run[at]].step / runs[series->run[at]].cost.particles)
            series->run[at] = run;
        return;
    }
    if (series->count == SERIES_RUNS)
        return;
    for (int k = series->count++; k > at; k--)
        series->run[k] = series->run[k - 1];
    series->run[at] = run;
}

/* Returns the least size above `above`; infinite if there is none. */
static double next_size(const SeriesRun *runs, int count, SeriesKind kind, double above)
{
    double least = (double)INFINITY;
    for (int k = 0; k < count; k++)
        if (size_of(&runs[k], kind) > above && size_of(&runs[k], kind) < least)
            least = size_of(&runs[k], kind);
    return least;
}

int series_find(const SeriesRun *runs, int count, Series series[SERIES_MOST])
{
    int found = 0;
    for (SeriesKind kind = SERIES_STRONG; kind < SERIES_KINDS; kind++) {
        double size = 0;
        while (found < SERIES_MOST && isfinite(size = next_size(runs, count, kind, size))) {
            const double most = size * (1 + alike[kind]);
            Series *one = &series[found];
            *one = (Series){.kind = kind};
            for (int k = 0; k < count; k++)
                if (size_of(&runs[k], kind) >= size && size_of(&runs[k], kind) <= most)
                    take(runs, one, k);
            found += one->count > 1;
            size = most;
        }
    }
    return found;
}

static double rate(const SeriesRun *run)
{
    return run->cost.particles / run->step;
}

double series_speedup(const SeriesRun *runs, const Series *series, int k)
{
    return rate(&runs[series->run[k]]) / rate(&runs[series->run[0]]);
}

double series_efficiency(const SeriesRun *runs, const Series *series, int k)
{
    return series_speedup(runs, series, k) * runs[series->run[0]].cost.cores /
           runs[series->run[k]].cost.cores;
}
