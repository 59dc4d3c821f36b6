/* The runs of `slosh fit`, one at a time, kept in a file like a chart's; no run is repeated. */
#ifndef SLOSH_FIT_RUNS_H
#define SLOSH_FIT_RUNS_H

#include "app/fit/fit_axes.h"

enum { FIT_REASONS = 64 };

typedef struct FitRuns {
    const FitAxes *axes;
    const char *csv; /* file of the runs */
    bool quiet;
    ChartRows kept;          /* all rows of the file */
    ChartRows used;          /* rows of this search, in the order of the requests */
    int there, made;         /* counts of runs taken from the file, and of new runs */
    ChartRow reference;      /* of a scene: compared with all runs */
    double floor;            /* greatest distance between runs with tiny jitters; NaN: a run broke */
    Notes own;               /* notes on the unchanged scene; settings with any further note are rejected */
    int warned;              /* count of settings rejected because of a note */
    char warning[NOTE_SIZE]; /* the first such note */
    int left_count;          /* count of distinct reasons for impossible settings; hashes: */
    uint64_t left_out[FIT_REASONS];
    Error error; /* why a run could not be made; "" after a signal */
} FitRuns;

/* Returns the count of CPU threads of the runs, which the costs depend on. */
int fit_threads(const Scene *scene);

/* Reads the file of runs. Returns false with the reason. */
bool fit_runs_begin(const FitAxes *axes, const char *csv, bool quiet, FitRuns *runs, Error *error);

/* Runs the unchanged scene with small jitters, and sets `floor` to the spread. Returns false with
   runs->error. */
bool fit_runs_floor(FitRuns *runs);

/* Makes the finest run of a scene; does nothing for a case. Returns false with runs->error. */
bool fit_runs_reference(FitRuns *runs);

/* Fills in the callbacks of the search. Call after fit_runs_floor. */
void fit_runs_space(FitRuns *runs, FitSpace *space);

#endif
