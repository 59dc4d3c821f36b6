/* Makes the trials that are not there yet, on several processes. */
#ifndef SLOSH_STABLE_RUN_H
#define SLOSH_STABLE_RUN_H

#include "app/stability/stable_plan.h"
#include "app/stability/stable_row.h"
#include "app/stability/stable_search.h"

/* Searches all cells, with trials of `rows` where they are there; what is made is added to them and written
   into the plan's file, from time to time and at the end. As many processes as the plan has threads take the
   cells one by one, and die with this one. False with the reason, or after a signal: the same command goes
   on. Before any world is made in this process: a fork keeps no threads. */
bool stable_run(const StablePlan *plan, StableRows *rows, Error *error);

/* The search of a cell by trials that are there; false where one is missing, or the cell is no scene that can
   be simulated, with the reason. */
bool stable_recall(const StablePlan *plan, int cell, const StableRows *rows, StableSearch *search,
                   Error *error);

#endif
