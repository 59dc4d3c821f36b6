/* Searches settings: the cheapest within an error, or the most accurate within a cost. Knows nothing about
   fluids: a setting is a place on each of some axes; its cost and error are requested one setting at a
   time, as rarely as possible.

   Order: 1. The unchanged scene. 2. Each line (a combination of the axes FIT_LINE, remaining axes
   unchanged) along the ladder from coarse to fine, until a rung is within the bound. 3. From the best of
   each line, the columns one step away along another axis, from their finest rung with a chance to be
   cheaper. A column has all settings that differ along the ladder alone. 4. From the best of all, the
   columns two steps away.

   A setting is not run if its predicted cost is more than FIT_MARGIN times the cost to beat. Prediction:
   the cost of the nearest finished setting of the same line, times the ratio of work.

   The best setting is checked twice. Errors fall with the spacing: if the next finer rung is outside the
   bound on the error, luck brought the setting within, and the setting is rejected. Then the run is
   repeated; a repeat beyond the bound also rejects. */
#ifndef SLOSH_FIT_SEARCH_H
#define SLOSH_FIT_SEARCH_H

#include <stdbool.h>

enum { FIT_AXES = 12, FIT_VALUES = 10, FIT_TRIES = 200 };

/* Predictions are off by about this factor. */
#define FIT_MARGIN 1.2

typedef struct FitPoint {
    int at[FIT_AXES]; /* a place on each axis */
} FitPoint;

typedef enum FitAxisKind {
    FIT_LINE,    /* names, each with its own ladder */
    FIT_LADDER,  /* one axis, from coarse to fine; cost grows along the axis */
    FIT_ORDERED, /* steps go to adjacent places */
    FIT_FREE     /* steps go to all places */
} FitAxisKind;

typedef struct FitAxis {
    FitAxisKind kind;
    int values, own; /* count of places; place of the unchanged scene */
} FitAxis;

typedef struct FitFigures {
    double cost;  /* any unit; NaN: the run broke */
    double error; /* a fraction; NaN: unknown */
    bool holds;   /* true if the setting may be chosen */
    int row;      /* for use by the callbacks */
} FitFigures;

typedef struct FitSpace {
    int axes;
    FitAxis axis[FIT_AXES];
    double scatter; /* errors with a smaller difference count as equal; 0: none do */
    double power;   /* cost grows as spacing^-power: dimensions + 1 */
    /* Returns true if the setting exists and differs from all earlier requests. */
    bool (*exists)(void *of, const FitPoint *point);
    /* Estimates the work, relative to other settings of the same line. */
    double (*work)(void *of, const FitPoint *point);
    /* Runs a setting; returns false to end the search. */
    bool (*run)(void *of, const FitPoint *point, double predicted, FitFigures *figures);
    /* Repeats a setting: `worst` gets the greatest error of all repeats, *holds is true if all repeats
       hold, and a longer run, too. NULL: no repeats. */
    bool (*repeat)(void *of, const FitPoint *point, const FitFigures *figures, double *worst, bool *holds);
    void *of;
} FitSpace;

/* One of the two bounds is INFINITY: the quantity to minimise. */
typedef struct FitGoal {
    double error, cost; /* bounds */
} FitGoal;

typedef enum FitFate {
    FIT_BEST,
    FIT_WITHIN, /* within the bound, but not better */
    FIT_BEYOND, /* outside the bound */
    FIT_BROKE,  /* broke, or does not hold */
    FIT_LUCK,   /* the next finer rung is beyond the bound */
    FIT_REPEAT, /* a repeat is beyond the bound */
    FIT_PRUNED  /* not run: predicted cost too high */
} FitFate;

typedef struct FitTry {
    FitPoint point;
    FitFigures figures;
    double predicted; /* cost; NaN: no prediction */
    double worst;     /* greatest error of the repeats; NaN: no repeats */
    double finer;     /* error of the next finer rung; NaN: not run */
    FitFate fate;
} FitTry;

typedef struct FitLadder {
    int count, best; /* best: index, or -1: no try is within the bound */
    bool full;       /* true: no room for further tries */
    FitTry tries[FIT_TRIES];
} FitLadder;

/* Searches. Returns false if `run` or `repeat` returned false; the ladder has the tries so far. */
bool fit_search(const FitSpace *space, const FitGoal *goal, FitLadder *ladder);

/* Returns the index of the try closest to the goal; -1: all broke. */
int fit_nearest(const FitLadder *ladder, const FitGoal *goal);

#endif
