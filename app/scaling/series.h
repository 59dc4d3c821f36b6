/* Groups runs on ranks. Strong scaling: the same particles on more and more ranks. Weak scaling: the same
   particles per rank. */
#ifndef SLOSH_SCALING_SERIES_H
#define SLOSH_SCALING_SERIES_H

#include "app/scaling/cost.h"

enum { SERIES_RUNS = 32, SERIES_MOST = 16 };

typedef enum SeriesKind { SERIES_STRONG, SERIES_WEAK, SERIES_KINDS } SeriesKind;

extern const char *const series_names[SERIES_KINDS];

/* A measured run. */
typedef struct SeriesRun {
    CostSample cost;
    double step; /* s */
} SeriesRun;

typedef struct Series {
    SeriesKind kind;
    int count;            /* two or more, ordered by ranks; no two with equal ranks */
    int run[SERIES_RUNS]; /* indices of runs */
} Series;

/* Finds all series among the runs, strong series first, each kind ordered by particles; of runs with equal
   size and ranks only the fastest. Particles of a strong series may differ by 2 %, particles per rank of a
   weak series by 15 %: a lattice allows no finer choice. Returns the count. */
int series_find(const SeriesRun *runs, int count, Series series[SERIES_MOST]);

/* Returns particle-steps per second of the k-th run of the series, over the first run's. */
double series_speedup(const SeriesRun *runs, const Series *series, int k);

/* The same per busy processor: 1 without loss. */
double series_efficiency(const SeriesRun *runs, const Series *series, int k);

#endif
