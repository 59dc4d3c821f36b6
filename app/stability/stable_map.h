/* What was found: of each cell where it holds, what is above, and what theory says. */
#ifndef SLOSH_STABLE_MAP_H
#define SLOSH_STABLE_MAP_H

#include "app/stability/stable_limits.h"
#include "app/stability/stable_plan.h"
#include "app/stability/stable_row.h"
#include "app/stability/stable_search.h"

typedef struct StableCellFound {
    StableCell cell;
    bool searched; /* else `why` not */
    char why[256];
    StableSearch search;
    StableLimits limits; /* of its scene */
    double ratio; /* the largest step that holds over limits.lattice; NaN without sound, or without a step */
} StableCellFound;

typedef struct StableMap {
    const StablePlan *plan;
    int count;
    StableCellFound *found; /* by the numbers of cells */
} StableMap;

/* From the trials alone, so that the map is the same however they were made. False without memory. */
bool stable_map_make(const StablePlan *plan, const StableRows *rows, StableMap *map, Error *error);
void stable_map_free(StableMap *map);

/* The largest step that holds, s; NaN where none does. */
double stable_largest(const StableCellFound *found);

/* Whether a sample above what fails holds again, or one below what holds fails: halving may have missed
   another limit. */
bool stable_uneven(const StableCellFound *found);

/* How many of the samples above what holds fail and are not found by the sentinel. */
int stable_silent(const StableCellFound *found);

/* The axis along which all cells that were searched are alike, -1 without one. */
int stable_idle_axis(const StableMap *map);

typedef struct StableSpread {
    int cells, never, always, uneven, silent, ratios; /* of cells; `silent`: with a sample that is */
    double least, median, most;                       /* of the ratios */
} StableSpread;

/* Of one series. */
StableSpread stable_spread(const StableMap *map, int series);

/* The map: a panel a series; over one axis, steps with the limits of theory. */
bool stable_draw(const StableMap *map, const char *path, Error *error);

/* A row a cell, and of each series the spread of its ratios. */
void stable_print(const StableMap *map, FILE *file);

/* {"stability": SCENE, "time", "step", "axes": [...], "maps": [{"method", "backend", "cells": [...]}],
   "error"}; what is not known is null. `failure`: why there is no map, or NULL. */
bool stable_write_json(const StableMap *map, const char *failure, const char *path, Error *error);

#endif
