/* What `slosh validate` says of its results: a table, JSON, a plot a case. */
#ifndef SLOSH_VALIDATE_REPORT_H
#define SLOSH_VALIDATE_REPORT_H

#include "app/case/run.h"

#include <stdio.h>

/* The line above the rows. */
void validate_print_head(FILE *file);

/* A row a metric: value, reference, error, tolerance, seconds. */
void validate_print(const CaseResult *result, FILE *file);

/* {"cases": [...], "error": failure}, one entry a case, metric, method and backend; what was not measured is
   null, and "failure" says why a run broke. `failure`: why there are not all of them, or NULL. */
bool validate_write_json(const CaseResult *results, size_t count, const char *failure, const char *path,
                         Error *error);

/* What was found and the reference, all methods of a case together: `results` are those of one case. */
bool validate_plot(const CaseResult *results, size_t count, const char *path, Error *error);

#endif
