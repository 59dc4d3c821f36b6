/* Runs on ranks that belong together: strong scaling has the same particles on ever more ranks, weak scaling
   as many particles a rank. */
#ifndef SLOSH_SERIES_H
#define SLOSH_SERIES_H

#include "app/scaling/cost.h"

enum { SERIES_RUNS = 32, SERIES_MOST = 16 };

typedef enum SeriesKind { SERIES_STRONG, SERIES_WEAK, SERIES_KINDS } SeriesKind;

extern const char *const series_names[SERIES_KINDS];

/* A run as it was measured. */
typedef struct SeriesRun {
    CostSample cost;
    double step; /* s */
} SeriesRun;

typedef struct Series {
    SeriesKind kind;
    int count;            /* two or more, of the fewest ranks first; no two of the same ranks */
    int run[SERIES_RUNS]; /* places in what was given */
} Series;

/* All series that the runs make, strong ones first, each kind from few particles to many; of runs of the same
   size and ranks the fastest. Particles of a strong series differ by 2 % at most, those a rank of a weak one
   by 15 %: a lattice has no more choice. Returns how many. */
int series_find(const SeriesRun *runs, int count, Series series[SERIES_MOST]);

/* Particle-steps a second, k-th run of the series over its first. */
double series_speedup(const SeriesRun *runs, const Series *series, int k);

/* The same for each processor at work: 1 where nothing is lost. */
double series_efficiency(const SeriesRun *runs, const Series *series, int k);

#endif
