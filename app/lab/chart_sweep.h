/* What --sweep of `slosh chart` makes: a series a combination of values, or, of particles.spacing, the axis.
 */
#ifndef SLOSH_CHART_SWEEP_H
#define SLOSH_CHART_SWEEP_H

#include "app/lab/chart_run.h"
#include "app/session/args.h"

enum { CHART_SPACINGS = 8, SWEPT_TEXT = 192, SWEEP_NAMES_MAX = 8 };

/* The keys but method, backend and spacing, with their values. */
typedef struct ChartSweeps {
    int count;
    const char *key[CHART_SWEEPS];
    int values[CHART_SWEEPS];
    char text[CHART_SWEEPS][ARGS_SWEEP_VALUES_MAX][SWEPT_TEXT]; /* "--sweep key=value" */
    bool effective[CHART_SWEEPS];                               /* with some method */
} ChartSweeps;

/* What --sweep, or else the last setting, says for a key such as solver.method: how many; 0 where the command
   line says nothing of it. */
int sweep_names(const Args *args, const char *key, const char *names[SWEEP_NAMES_MAX]);

/* Takes those of the command line; false for a key that a chart cannot have, with the reason. Whether the
   scene can be read with the values is the caller's to see. */
bool chart_sweeps_take(const Args *args, ChartSweeps *sweeps, Error *error);

/* How many combinations there are; 1 without sweeps. */
int chart_sweeps_combinations(const ChartSweeps *sweeps);

/* Whether the key has an effect on the scene, as it was read with a method; without, why (of OUTPUT size). */
bool chart_sweeps_effect(ChartSweeps *sweeps, int key, const Scene *scene, char why[NOTE_SIZE]);

/* The settings of a combination; a key without effect (`effect`) has none. False where the combination
   differs from an earlier one in nothing but keys without effect. */
bool chart_sweeps_set(const ChartSweeps *sweeps, const bool effect[CHART_SWEEPS], int combination,
                      ChartJob *job);

/* Fails where a key has an effect with no method. */
bool chart_sweeps_check(const ChartSweeps *sweeps, Error *error);

/* The spacings of --sweep particles.spacing, times that of the scene, the coarsest first; how many: 0
   without. -1: one is no number above 0, or there are too many, with the reason. */
int chart_sweeps_spacings(const Args *args, double spacing, double coarsenings[CHART_SPACINGS], Error *error);

#endif
