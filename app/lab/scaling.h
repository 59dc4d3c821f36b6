/* A model of a step's cost on ranks: few numbers, fitted to measured runs, and used to predict further runs.
   A prediction is no measurement.

   A step of n particles on p ranks with c busy processors takes

       compute   a n / c
       exchange  latency * messages + bytes / bandwidth
       balance   b n / p
       wait      w * compute, 0 on a single rank

   A rank has k (n / p)^(2/3) ghost particles for each of its faces towards neighbour ranks (surface to
   volume; ^(1/2) in two dimensions). Each ghost costs the same bytes per step, and each neighbour the
   same messages. Faces and neighbours are counted on a lattice of ranks, cut repeatedly along its longest
   side: 1 and 1 for two ranks, 2 and 3 for four, near 6 and 26 for many. */
#ifndef APP_LAB_SCALING_H
#define APP_LAB_SCALING_H

#include "sim/error.h"

/* A run, as means over ranks and steps. */
typedef struct CostSample {
    double particles;                        /* total of all ranks */
    int ranks, cores;                        /* cores: busy processors of all ranks */
    double compute, exchange, balance, wait; /* s per step */
    double ghosts;                           /* per rank */
    double bytes, messages;                  /* sent by a rank per step */
} CostSample;

typedef struct CostModel {
    int dimensions;            /* 2 or 3 */
    double compute;            /* a: s per particle and processor */
    double surface;            /* k */
    double bytes, messages;    /* per ghost and step; per neighbour and step */
    double latency, bandwidth; /* s per message; bytes/s, infinite if the measured cost of bytes is zero */
    double balance, wait;      /* b: s per particle of a rank; w */
} CostModel;

/* Fits the model: means over the samples; latency and bandwidth by least squares of relative errors. At
   least one sample must have more than one rank. If all samples have the same size, the whole exchange
   counts as bytes. Returns false with the reason if samples are missing. */
bool cost_fit(const CostSample *samples, int count, int dimensions, CostModel *model, Error *error);

/* Predicts a run; all arguments 1 or more. */
CostSample cost_predict(const CostModel *model, double particles, int ranks, int cores);

/* Returns the time of a step, s. */
double cost_step(const CostSample *sample);

/* Groups runs on ranks. Strong scaling: the same particles on more and more ranks. Weak scaling: the same
   particles per rank. */

enum { SCALING_RUNS = 32, SCALING_SERIES_MAX = 16 };

typedef enum ScalingKind { SCALING_STRONG, SCALING_WEAK, SCALING_KINDS } ScalingKind;

extern const char *const scaling_names[SCALING_KINDS];

/* A measured run. */
typedef struct ScalingRun {
    CostSample cost;
    double step; /* s */
} ScalingRun;

typedef struct ScalingSeries {
    ScalingKind kind;
    int count;             /* two or more, ordered by ranks; no two with equal ranks */
    int run[SCALING_RUNS]; /* indices of runs */
} ScalingSeries;

/* Finds all series among the runs, strong series first, each kind ordered by particles; of runs with equal
   size and ranks only the fastest. Particles of a strong series may differ by 2 %, particles per rank of a
   weak series by 15 %: a lattice allows no finer choice. Returns the count. */
int scaling_series_find(const ScalingRun *runs, int count, ScalingSeries series[SCALING_SERIES_MAX]);

/* Returns particle-steps per second of the k-th run of the series, over the first run's. */
double scaling_speedup(const ScalingRun *runs, const ScalingSeries *series, int k);

/* The same per busy processor: 1 without loss. */
double scaling_efficiency(const ScalingRun *runs, const ScalingSeries *series, int k);

#endif
