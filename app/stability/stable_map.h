/* Results of `slosh stability`: of each cell the largest stable step, the outcomes above, and the
   theoretical limits. */
#ifndef SLOSH_STABLE_MAP_H
#define SLOSH_STABLE_MAP_H

#include "app/stability/stable_limits.h"
#include "app/stability/stable_plan.h"
#include "app/stability/stable_row.h"
#include "app/stability/stable_search.h"

typedef struct StableCellFound {
    StableCell cell;
    bool searched; /* false: `why` has the reason */
    char why[256];
    StableSearch search;
    StableLimits limits; /* of the cell's scene */
    double ratio;        /* largest stable step over limits.lattice; NaN without sound, or if no step holds */
} StableCellFound;

typedef struct StableMap {
    const StablePlan *plan;
    int count;
    StableCellFound *found; /* indexed by cell number */
} StableMap;

/* Makes the map from the trials alone: the map does not depend on the order of the trials. Returns false
   if memory is short. */
bool stable_map_make(const StablePlan *plan, const StableRows *rows, StableMap *map, Error *error);
void stable_map_free(StableMap *map);

/* Returns the largest stable step, s; NaN if none holds. */
double stable_largest(const StableCellFound *found);

/* True if a sample above a failing step holds, or a sample below a holding step fails: halving may have
   missed another limit. */
bool stable_uneven(const StableCellFound *found);

/* Returns the count of failing samples above the largest step, undetected by the sentinel. */
int stable_silent(const StableCellFound *found);

/* Returns an axis without effect on any searched cell, or -1. */
int stable_idle_axis(const StableMap *map);

typedef struct StableSpread {
    int cells, never, always, uneven, silent, ratios; /* cell counts; `silent`: cells with a silent sample */
    double least, median, most;                       /* of the ratios */
} StableSpread;

/* Returns the spread of one series. */
StableSpread stable_spread(const StableMap *map, int series);

/* Draws the map, one panel per series; over one axis, the steps with the limits of theory. */
bool stable_draw(const StableMap *map, const char *path, Error *error);

/* Prints one row per cell, and for each series the spread of its ratios. */
void stable_print(const StableMap *map, FILE *file);

/* Writes {"stability": SCENE, "time", "step", "axes": [...], "maps": [{"method", "backend", "cells":
   [...]}], "error"}; unknown values are null. `failure`: why there is no map, or NULL. */
bool stable_write_json(const StableMap *map, const char *failure, const char *path, Error *error);

#endif
