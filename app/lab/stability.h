/* The axes of a map: set by --axis, or chosen for the scene. */
#ifndef APP_LAB_STABILITY_H
#define APP_LAB_STABILITY_H

#include "app/lab/experiment.h"
#include "app/run/measure/measure.h"
#include "app/scene/scene.h"
#include "sim/base/key.h"
#include "sim/def.h"

#include <stdint.h>
#include <stdio.h>

enum { STABLE_AXES = 2, STABLE_POINTS = 32, STABLE_KEY = 96, STABLE_VALUE = 32 };

typedef struct StableAxis {
    char key[STABLE_KEY];
    const Key *row;
    int count;
    bool logarithmic; /* if the axis spans a decade or more */
    double value[STABLE_POINTS];
    char text[STABLE_POINTS][STABLE_VALUE]; /* as in a scene file */
} StableAxis;

/* Theoretical limits of the step. */

/* s; INFINITY: no limit */
typedef struct StableLimits {
    double sound;    /* 2 / omega of the stiffest wave on the lattice: sim/kernel/kernel.h */
    double friction; /* step_viscous */
    /* Limit for sound and friction together. A Verlet step with friction from the velocity at the start of
       the step is stable if omega^2 dt^2 + 2 gamma dt < 4. The greatest omega and the greatest gamma = 2 /
       friction belong to different waves: the limit is shorter than the largest stable step, at worst 0.62
       times, where both are equal. */
    double lattice;
    /* Textbook limits, with the smoothing length l = h / 2 and the greatest kinematic viscosity nu; after
       J. J. Monaghan 1992 and J. P. Morris 1997. */
    double courant; /* 0.4 l / c */
    double force;   /* 0.25 sqrt(l / g) */
    double viscous; /* 0.125 l^2 / nu */
} StableLimits;

/* Computes the limits for the def's method and settings. Takes some milliseconds. */
void stable_limits(const WorldDef *def, StableLimits *limits);

/* Plan of `slosh stability`: methods x backends, each over a grid of one or two keys of the scene. */

enum { STABLE_SERIES = 16 };

typedef struct StableSeries {
    char method[NAME_SIZE], backend[NAME_SIZE];
    bool effect[STABLE_AXES]; /* true if the method reads the axis; if false, one cell is enough */
} StableSeries;

/* The options of `slosh stability`: Args.own. */
typedef struct StabilityOptions {
    const char *axes[ARGS_LIST_MAX]; /* "KEY=a:b"; ends with NULL */
} StabilityOptions;

typedef struct StablePlan {
    const Args *args;
    const char *scene_name;
    Scene scene; /* as set by the command line */
    Notes notes; /* of the scene */
    double time; /* simulated time of a trial, s */
    int threads; /* total of all processes */
    int axis_count;
    StableAxis axis[STABLE_AXES];
    int series_count;
    StableSeries series[STABLE_SERIES];
} StablePlan;

/* One cell of the grid of a series. */
typedef struct StableCell {
    int series, at[STABLE_AXES];
} StableCell;

/* Makes the plan. Returns false with the reason if the command line or the scene is wrong. Methods and
   backends: those of the command line, else the scene's own. An axis not read by a method is reported on
   standard error. Errors: an axis not read by any method; --particles with the spacing as an axis. */
bool stable_plan_make(const Args *args, StablePlan *plan, Error *error);

/* Returns the count of cells along an axis; 1 if the axis does not exist. */
int stable_points(const StablePlan *plan, int axis);

/* Count of cells of all series together. Cell numbers: the last axis varies fastest. */
int stable_cells(const StablePlan *plan);
StableCell stable_cell(const StablePlan *plan, int number);

/* Returns the number of the cell searched in place of cell `number`: the first cell along each axis
   without effect on the method. */
int stable_searched(const StablePlan *plan, int number);

/* Loads the cell's scene with the scene's own step (`rung` NULL), or with the step of a rung. Mode fixed,
   one step per frame so that energy is checked often, sentinel on, one thread. */
bool stable_scene(const StablePlan *plan, StableCell cell, const int *rung, Scene *scene, Error *error);

/* Returns the first and the highest rung of the cell's search. */
void stable_range(const StablePlan *plan, const Scene *scene, int *first, int *most);

/* Fills in the cell's settings, such as "solver.sound_speed=14 fluids[0].viscosity=2". */
void stable_at(const StablePlan *plan, StableCell cell, char *text, size_t size);

/* Trials of `slosh stability`, kept in a CSV file, so that no trial is repeated. */

enum { STABLE_AT = 192 };

/* Finder of the failure. X(ENUM, word) */
#define STABLE_FINDERS(X)                                                                                    \
    X(NOBODY, "nobody")     /* the trial holds */                                                            \
    X(SENTINEL, "sentinel") /* ended the trial */                                                            \
    X(LOOK, "look")         /* ended the trial */                                                            \
    X(LOOKS, "looks")       /* only looks; the trial went on to its end */

typedef enum StableFinder {
#define X(NAME, word) FOUND_BY_##NAME,
    STABLE_FINDERS(X)
#undef X
        STABLE_FINDER_COUNT
} StableFinder;

/* The outcome of a scene at one step. */
typedef struct StableRow {
    uint64_t key; /* hash of all inputs of the trial */
    char method[NAME_SIZE], backend[NAME_SIZE];
    int rung;           /* of the step */
    double step;        /* s */
    char at[STABLE_AT]; /* "solver.sound_speed=14 fluids[0].viscosity=2" */
    uint64_t steps;     /* made */
    StableFinder finder;
    Outcome outcome;
} StableRow;

extern const TrialTable stable_table;

/* The search for the largest stable step, independent of how trials are made. Steps lie on a ladder with
   STABLE_RUNGS rungs per factor of two. All searches use the same ladder, so that no trial depends on the
   number of processes. */

/* STABLE_DOWN: the lowest rung tried is so far below the first, an eighth of its step. STABLE_ABOVE: count
   of samples above the largest stable step. STABLE_BELOW: rungs below, to check a shorter step, 0.71
   times. STABLE_STARTS: starts of each trial near the limit, where chance decides. */
enum { STABLE_RUNGS = 8, STABLE_DOWN = 24, STABLE_ABOVE = 4, STABLE_BELOW = 4, STABLE_STARTS = 4 };

/* Rungs above the largest stable step, sampled for the kinds of failure: 1.09, 1.3, 1.54 and 2 times the
   step. */
extern const int stable_above[STABLE_ABOVE];

typedef struct StableFound {
    OutcomeKind kind; /* OUTCOME_NONE: not tried */
    bool silent;      /* found by a look, not by the sentinel; in a `whole` trial not until its end */
} StableFound;

/* Makes a trial at a rung, from a start. Returns false if the search cannot go on. `whole`: a failure
   found by a look does not end the trial. */
typedef bool StableTry(void *context, int rung, int start, bool whole, StableFound *found);

typedef enum StableEnd {
    STABLE_FOUND,
    STABLE_NEVER, /* no rung holds; `rung` is the lowest tried */
    STABLE_ALWAYS /* all rungs hold; `rung` is the highest tried */
} StableEnd;

typedef struct StableSearch {
    StableEnd end;
    int rung;                        /* the largest that holds from all starts, as do all lower rungs tried */
    StableFound above[STABLE_ABOVE]; /* at stable_sample(): the first failing start */
    int again;                       /* the highest rung that holds from at least one start; else `rung` */
} StableSearch;

/* Returns the rung of a sample: rung + stable_above[]; for STABLE_NEVER the rungs tried: `rung` and
   upwards by factors of two. */
int stable_sample(const StableSearch *search, int sample);

/* stable_step: the step of a rung, s. stable_rung: the rung nearest to a step. */
double stable_step(int rung);
int stable_rung(double step);

/* Searches from rung `first` up or down by factors of two until a holding and a failing rung are known,
   then by bisection, from one start. Then goes down until all starts hold at the rung and at the next
   lower rung, and one start STABLE_BELOW rungs below. No rung above `most` is tried. Returns false if a
   trial could not be made. */
bool stable_search(StableTry *attempt, void *context, int first, int most, StableSearch *search);

/* One trial: a scene at a fixed step, until the first trouble. */

enum { STABLE_LOOKS = 16 };

/* Makes the missing trials, on several processes. */

/* Searches all cells, reusing the trials in `rows`. New trials are added to `rows` and written to the
   file, regularly and at the end. As many processes as the plan has threads take the cells one by
   one; the processes die with the caller. Returns false with the reason, or after a signal: the same
   command resumes. Call before making any world in the calling process: fork copies no threads. */
bool stable_run(const StablePlan *plan, Trials *rows, const char *csv, Error *error);

/* Repeats the search of a cell from the trials in `rows`. Returns false with the reason if a trial is
   missing, or the cell's scene cannot be simulated. */
bool stable_recall(const StablePlan *plan, int cell, const Trials *rows, StableSearch *search, Error *error);

/* Results of `slosh stability`: of each cell the largest stable step, the outcomes above, and the
   theoretical limits. */

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
bool stable_map_make(const StablePlan *plan, const Trials *rows, StableMap *map, Error *error);
void stable_map_free(StableMap *map);

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

/* {"stability": SCENE, "time", "step", "axes": [...], "maps": [{"method", "backend", "cells": [...]}],
   "error"}; unknown values are null. `failure`: why there is no map, or NULL. */
json_t *stable_json(const StableMap *map, const char *failure);

#endif
