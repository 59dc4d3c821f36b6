/* The metrics of a scene: what `slosh chart` compares of two runs. The one list of their names, which the
   scene key `metrics`, `slosh info` and the documentation read. */
#ifndef SLOSH_METRIC_LIST_H
#define SLOSH_METRIC_LIST_H

#include "app/metric/cloud.h"

enum { METRIC_NUMBERS = 3, METRIC_PROBES = 16 }; /* that one may have; that of a scene's probes */

/* A state, as metrics are made from it. */
typedef struct MetricState {
    const WorldDef *def;
    WorldInfo info;
    WorldSums sums;
    Cloud cloud; /* empty where no metric reads the particles */
    /* What the scene's probes read, the first number of each; who asks fills it in behind metric_state_read.
     */
    int probe_count;
    double probe[METRIC_PROBES];
} MetricState;

typedef struct MetricKind {
    const char *name, *unit, *help;
    int numbers;    /* 1, or 3: x y z, compared as one, over the greatest range of the three; 0: one a probe,
                       each over its own range, and their mean */
    bool particles; /* wants MetricState.cloud */
    void (*of)(const MetricState *state, double out[]); /* NaN where the state has none */
} MetricKind;

/* Ended by a NULL name. */
extern const MetricKind metric_kinds[];

/* How many numbers a metric has in a scene of so many probes. */
int metric_numbers(int metric, int probe_count);

/* What a scene that names none is compared by: their places in the list; how many. */
int metric_defaults(int metrics[]);

/* Zero-initialise `state`. Fills it for those metrics; false when memory is short. metric_state_free at the
   end. */
bool metric_state_read(MetricState *state, const WorldDef *def, World *world, const int metrics[], int count);
void metric_state_free(MetricState *state);

#endif
