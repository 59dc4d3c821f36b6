/* The metrics of a scene: what `slosh chart` compares of two runs. The one list of their names, which the
   scene key `metrics`, `slosh info` and the documentation read. */
#ifndef SLOSH_METRIC_LIST_H
#define SLOSH_METRIC_LIST_H

#include "app/metric/cloud.h"

enum { METRIC_NUMBERS = 3 }; /* that one may have */

/* A state, as metrics are made from it. */
typedef struct MetricState {
    const WorldDef *def;
    WorldInfo info;
    WorldSums sums;
    Cloud cloud; /* empty where no metric reads the particles */
} MetricState;

typedef struct MetricKind {
    const char *name, *unit, *help;
    int numbers;    /* 1, or 3: x y z, compared as one, over the greatest range of the three */
    bool particles; /* wants MetricState.cloud */
    void (*of)(const MetricState *state, double out[METRIC_NUMBERS]); /* NaN where the state has none */
} MetricKind;

/* Ended by a NULL name. */
extern const MetricKind metric_kinds[];

/* What a scene that names none is compared by: their places in the list; how many. */
int metric_defaults(int metrics[]);

/* Zero-initialise `state`. Fills it for those metrics; false when memory is short. metric_state_free at the
   end. */
bool metric_state_read(MetricState *state, const WorldDef *def, World *world, const int metrics[], int count);
void metric_state_free(MetricState *state);

#endif
