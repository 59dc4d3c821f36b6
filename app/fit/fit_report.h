/* Reports of `slosh fit`: a table, JSON. */
#ifndef SLOSH_FIT_REPORT_H
#define SLOSH_FIT_REPORT_H

#include "app/fit/fit_plan.h"

/* Prints one line per run, in the order of the runs, with the reason for its choice or rejection; then the
   settings not run. */
void fit_print(const FitPlan *plan, FILE *file);

/* Writes {"fit": subject, "error_of", "goal": {"error" or "frame_ms", "cost"}, "floor", "processor",
   "threads", "best": place in "runs" or null, "output", "runs": [...], "pruned": [...], "error": failure};
   unknown values are null. `failure`: why there is no scene, or NULL. */
bool fit_write_json(const FitPlan *plan, const char *failure, const char *path, Error *error);

#endif
