/* The metrics of a scene: `slosh chart` compares two runs by them. This is the only list of their names,
   used by the scene key `metrics`, `slosh info` and the documentation. */
#ifndef SLOSH_METRIC_LIST_H
#define SLOSH_METRIC_LIST_H

#include "app/metric/cloud.h"

enum { METRIC_NUMBERS = 3, METRIC_PROBES = 16 }; /* greatest count of numbers of a metric; of probes */

/* A state, input of the metrics. */
typedef struct MetricState {
    const WorldDef *def;
    WorldInfo info;
    WorldSums sums;
    Cloud cloud; /* empty if no metric reads particles */
    /* First number of each of the scene's probes; the caller fills in both after metric_state_read. */
    int probe_count;
    double probe[METRIC_PROBES];
} MetricState;

typedef struct MetricKind {
    const char *name, *unit, *help;
    int numbers;    /* 1; or 3: x y z, compared as a vector, over the greatest range of the three; 0: one
                       per probe, each compared over its own range, then averaged */
    bool particles; /* needs MetricState.cloud */
    void (*of)(const MetricState *state, double out[]); /* NaN if the state has no value */
} MetricKind;

/* Ended by a NULL name. */
extern const MetricKind metric_kinds[];

/* Returns the count of numbers of a metric in a scene with `probe_count` probes. */
int metric_numbers(int metric, int probe_count);

/* Fills in the indices of the default metrics; returns their count. */
int metric_defaults(int metrics[]);

/* Fills in `state` for the given metrics. Zero-initialise `state` before the first call; call
   metric_state_free at the end. Returns false if memory is short. */
bool metric_state_read(MetricState *state, const WorldDef *def, World *world, const int metrics[], int count);
void metric_state_free(MetricState *state);

#endif
