/* --sweep of `slosh chart`: one series per combination of values; particles.spacing gives the axis
   instead. */
#ifndef SLOSH_CHART_SWEEP_H
#define SLOSH_CHART_SWEEP_H

#include "app/lab/chart_run.h"
#include "app/session/args.h"

enum { CHART_SPACINGS = 8, SWEPT_TEXT = 192, SWEEP_NAMES_MAX = 8 };

/* All swept keys but method, backend and spacing, with their values. */
typedef struct ChartSweeps {
    int count;
    const char *key[CHART_SWEEPS];
    int values[CHART_SWEEPS];
    char text[CHART_SWEEPS][ARGS_SWEEP_VALUES_MAX][SWEPT_TEXT]; /* "--sweep key=value" */
    bool effective[CHART_SWEEPS];                               /* with at least one method */
} ChartSweeps;

/* Returns the values of --sweep, or else of the last setting, for a key such as solver.method, and their
   count; 0 if the command line does not set the key. */
int sweep_names(const Args *args, const char *key, const char *names[SWEEP_NAMES_MAX]);

/* Takes the sweeps of the command line. Returns false with the reason for a key not possible in a chart.
   The caller must check if the scene can be read with the values. */
bool chart_sweeps_take(const Args *args, ChartSweeps *sweeps, Error *error);

/* Returns the count of combinations; 1 without sweeps. */
int chart_sweeps_combinations(const ChartSweeps *sweeps);

/* Returns true if the key has an effect on the scene, as read with a method; else `why` has the reason. */
bool chart_sweeps_effect(ChartSweeps *sweeps, int key, const Scene *scene, char why[NOTE_SIZE]);

/* Adds the settings of a combination to the job; keys without effect (see `effect`) are skipped. Returns
   false if the combination differs from an earlier combination only in keys without effect. */
bool chart_sweeps_set(const ChartSweeps *sweeps, const bool effect[CHART_SWEEPS], int combination,
                      ChartJob *job);

/* Fails if a key has no effect with any method. */
bool chart_sweeps_check(const ChartSweeps *sweeps, Error *error);

/* Fills in the spacings of --sweep particles.spacing as multiples of the scene's spacing, coarsest first.
   Returns their count, 0 without the sweep; -1 with the reason if a value is no number above 0, or there
   are too many. */
int chart_sweeps_spacings(const Args *args, double spacing, double coarsenings[CHART_SPACINGS], Error *error);

#endif
