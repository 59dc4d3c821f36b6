/* What `slosh validate` says of its results: a table, JSON, a plot a case. */
#ifndef SLOSH_VALIDATE_REPORT_H
#define SLOSH_VALIDATE_REPORT_H

#include "app/case/run.h"
#include "app/outcome/outcome.h"

#include <stdio.h>

/* The line above the rows. */
void validate_print_head(FILE *file);

/* A row a metric: value, reference, error, tolerance, seconds; why it misses; how the run went but where it
   holds, whose words follow in a line. */
void validate_print(const CaseResult *result, const Outcome *outcome, FILE *file);

/* {"cases": [...], "error": failure}, one entry a case, metric, method and backend; what was not measured is
   null, "failure" says why a run broke, "why" what a miss comes of where that is known, "outcome" how the run
   went (outcome_json). `outcomes`: one a result. `failure`: why there are not all of them, or NULL. */
bool validate_write_json(const CaseResult *results, const Outcome *outcomes, size_t count,
                         const char *failure, const char *path, Error *error);

/* What was found and the reference, all methods of a case together: `results` are those of one case. */
bool validate_plot(const CaseResult *results, size_t count, const char *path, Error *error);

#endif
