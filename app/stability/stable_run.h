/* Makes the missing trials, on several processes. */
#ifndef SLOSH_STABLE_RUN_H
#define SLOSH_STABLE_RUN_H

#include "app/stability/stable_plan.h"
#include "app/stability/stable_row.h"
#include "app/stability/stable_search.h"

/* Searches all cells, reusing the trials in `rows`. New trials are added to `rows` and written to the
   plan's file, regularly and at the end. As many processes as the plan has threads take the cells one by
   one; the processes die with the caller. Returns false with the reason, or after a signal: the same
   command resumes. Call before making any world in the calling process: fork copies no threads. */
bool stable_run(const StablePlan *plan, StableRows *rows, Error *error);

/* Repeats the search of a cell from the trials in `rows`. Returns false with the reason if a trial is
   missing, or the cell's scene cannot be simulated. */
bool stable_recall(const StablePlan *plan, int cell, const StableRows *rows, StableSearch *search,
                   Error *error);

#endif
