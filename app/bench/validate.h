/* Watches a case during its run to judge the outcome (app/run/measure/outcome.h). */
#ifndef APP_BENCH_VALIDATE_H
#define APP_BENCH_VALIDATE_H

#include "app/bench/cases/case.h"
#include "app/run/measure/outcome.h"

#include <stdio.h>

typedef struct CaseWatch {
    OutcomeHistory history;
    bool looked;
    double every, next; /* s */
} CaseWatch;

CaseWatch case_watch_begin(const Case *of);

/* CaseSetup.watch callback; watcher is a CaseWatch. Looks at some of the case's states. */
void case_watch(void *watcher, const WorldDef *def, World *world);

/* Fills in the outcome; after a broken run, with the reason. */
void case_watch_outcome(CaseWatch *watch, const CaseResult *result, Outcome *outcome);

/* Reports of `slosh validate`: a table, JSON, one plot per case. */

/* Prints the head line of the table. */
void validate_print_head(FILE *file);

/* Prints one row per metric: value, reference, error, tolerance, seconds; the reason of a miss. If the
   outcome is not OUTCOME_HOLDS, its word and a line with its details follow. */
void validate_print(const CaseResult *result, const Outcome *outcome, FILE *file);

/* Writes {"cases": [...], "error": failure}, one entry per case, metric, method and backend. Unmeasured
   values are null; "failure" says why a run broke, "why" gives the known cause of a miss, "outcome" the
   outcome (outcome_json). `outcomes`: one per result. `failure`: why results are missing, or NULL. */
bool validate_write_json(const CaseResult *results, const Outcome *outcomes, size_t count,
                         const char *failure, const char *path, Error *error);

/* Plots the measured and reference curves of one case, all methods together. All `results` must be of one
   case. */
bool validate_plot(const CaseResult *results, size_t count, const char *path, Error *error);

#endif
