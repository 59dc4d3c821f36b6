/* Reports of `slosh validate`: a table, JSON, one plot per case. */
#ifndef SLOSH_VALIDATE_REPORT_H
#define SLOSH_VALIDATE_REPORT_H

#include "app/case/run.h"
#include "app/run/measure/outcome.h"

#include <stdio.h>

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
