/* The plan of `slosh bench`: scenes, and the settings of each case. */
#ifndef SLOSH_BENCH_PLAN_H
#define SLOSH_BENCH_PLAN_H

#include "app/lab/bench_table.h"
#include "app/scene/scene.h"
#include "app/session/args.h"

/* Each scene with each combination of the sweeps' values; the last sweep varies fastest. */
typedef struct Plan {
    const Args *args;
    const char *const *scenes;
    size_t scene_count, combinations;
    const Table *table; /* or NULL */
    SceneSettings settings;
    int sweep_count;
    Sweep sweeps[ARGS_SWEEPS_MAX];
    const char *narrowed[ARGS_SWEEPS_MAX]; /* for a table: source of the single value, as in SceneSettings */
} Plan;

bool plan_make(const Args *args, Plan *plan, Error *error);

size_t plan_cases(const Plan *plan);

/* Name of the case among the cases of its scene, for people; "" without sweeps. */
void plan_case_name(const Plan *plan, size_t index, char *name, size_t size);

/* Loads the scene of a case; `tell`: prints the loader's notes on standard error. */
bool plan_case_load(const Plan *plan, size_t index, bool tell, Scene *scene, Error *error);

#endif
