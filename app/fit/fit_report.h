/* What `slosh fit` says of what it tried: a table, JSON. */
#ifndef SLOSH_FIT_REPORT_H
#define SLOSH_FIT_REPORT_H

#include "app/fit/fit_plan.h"

/* A line a run, in the order in which they were made, with why it was kept or left; then what was not run. */
void fit_print(const FitPlan *plan, FILE *file);

/* {"fit": subject, "error_of", "goal": {"error" or "frame_ms", "cost"}, "floor", "processor", "threads",
   "best": place in "runs" or null, "output", "runs": [...], "pruned": [...], "error": failure}; what is not
   known is null. `failure`: why there is no scene, or NULL. */
bool fit_write_json(const FitPlan *plan, const char *failure, const char *path, Error *error);

#endif
