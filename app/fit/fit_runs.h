/* The runs of `slosh fit`: made one at a time, kept in a file as those of a chart, none made twice. */
#ifndef SLOSH_FIT_RUNS_H
#define SLOSH_FIT_RUNS_H

#include "app/fit/fit_axes.h"

enum { FIT_REASONS = 64 };

typedef struct FitRuns {
    const FitAxes *axes;
    const char *csv; /* where they are kept */
    bool quiet;
    ChartRows kept;     /* all of the file */
    ChartRows used;     /* of this search, in the order in which it asked for them */
    int there, made;    /* runs that were in the file already, and others */
    ChartRow reference; /* of a scene: what all are compared with */
    double floor;       /* how far runs are apart that differ by a millionth of a spacing; NaN: they broke */
    Notes own;          /* what is said of the scene as it is; of what is offered nothing else may be said */
    int warned;         /* settings that were left since something is; */
    char warning[NOTE_SIZE]; /* the first of these lines */
    int left_count;          /* reasons why settings could not be made, that were said: */
    uint64_t left_out[FIT_REASONS];
    Error error; /* why a run could not be made; "" where a signal came */
} FitRuns;

/* Of the CPU, that costs are measured with. */
int fit_threads(const Scene *scene);

/* Reads what is kept. False with the reason. */
bool fit_runs_begin(const FitAxes *axes, const char *csv, bool quiet, FitRuns *runs, Error *error);

/* The scatter of the scene as it is: its spread, into `floor`. False: see error. */
bool fit_runs_floor(FitRuns *runs);

/* The finest run of a scene; nothing of a case. False: see error. */
bool fit_runs_reference(FitRuns *runs);

/* What the search asks for; the floor is known. */
void fit_runs_space(FitRuns *runs, FitSpace *space);

#endif
