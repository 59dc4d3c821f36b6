/* Searches settings: the cheapest within an error, or the most accurate within a cost. It knows no fluid: a
   setting is a place on each of some axes, and what it costs and how far off it is are asked for, one setting
   at a time, as seldom as can be.

   In this order: the scene as it is; each line (a combination of the axes FIT_LINE, all others as they are)
   along the ladder from coarse to fine until it is within; from the best of each line columns (settings that
   differ along the ladder alone) that are one step off along another axis, from their finest rung that may be
   cheaper; from the best of all columns that are two steps off. Nothing is run that is predicted to cost
   FIT_MARGIN times what it is to beat: the cost of the nearest setting of its line that was run, times the
   ratio of their work. What is best is asked for twice more. Errors fall with the spacing: where its next
   finer rung is outside the bound on the error, luck brought it within, and it is left. Then it is repeated;
   a repeat that is beyond the bound counts. */
#ifndef SLOSH_FIT_SEARCH_H
#define SLOSH_FIT_SEARCH_H

#include <stdbool.h>

enum { FIT_AXES = 12, FIT_VALUES = 10, FIT_TRIES = 200 };

/* Predictions miss by about so much. */
#define FIT_MARGIN 1.2

typedef struct FitPoint {
    int at[FIT_AXES]; /* a place on each axis */
} FitPoint;

typedef enum FitAxisKind {
    FIT_LINE,    /* names, each with a ladder of its own */
    FIT_LADDER,  /* one axis: from coarse to fine; cost grows along it */
    FIT_ORDERED, /* steps go to the places beside */
    FIT_FREE     /* steps go to all places */
} FitAxisKind;

typedef struct FitAxis {
    FitAxisKind kind;
    int values, own; /* how many places; that of the scene as it is */
} FitAxis;

typedef struct FitFigures {
    double cost;  /* any unit; NaN: it broke */
    double error; /* a fraction; NaN: not known */
    bool holds;   /* whether it may be chosen */
    int row;      /* the asker's own */
} FitFigures;

typedef struct FitSpace {
    int axes;
    FitAxis axis[FIT_AXES];
    double scatter; /* errors that differ by no more are alike; 0: none are */
    double power;   /* cost grows as spacing^-power: dimensions + 1 */
    /* Whether there is such a setting that differs from all that were asked for. */
    bool (*exists)(void *of, const FitPoint *point);
    /* About what it takes beside others of its line. */
    double (*work)(void *of, const FitPoint *point);
    /* Runs it; false: the search ends. */
    bool (*run)(void *of, const FitPoint *point, double predicted, FitFigures *figures);
    /* Repeats it: `worst` gets the greatest error of all, and *holds whether all do, and longer ones. NULL:
     * none. */
    bool (*repeat)(void *of, const FitPoint *point, const FitFigures *figures, double *worst, bool *holds);
    void *of;
} FitSpace;

/* One of the two is INFINITY: what is to be as small as can be. */
typedef struct FitGoal {
    double error, cost; /* bounds */
} FitGoal;

typedef enum FitFate {
    FIT_BEST,   /* chosen */
    FIT_WITHIN, /* within the bound, but no better */
    FIT_BEYOND, /* outside the bound */
    FIT_BROKE,  /* broke, or does not hold */
    FIT_LUCK,   /* its next finer rung is beyond */
    FIT_REPEAT, /* a repeat of it is beyond */
    FIT_PRUNED  /* not run: predicted too dear */
} FitFate;

typedef struct FitTry {
    FitPoint point;
    FitFigures figures;
    double predicted; /* cost; NaN: nothing was known */
    double worst;     /* error of its repeats; NaN: none */
    double finer;     /* error of its next finer rung; NaN: not asked */
    FitFate fate;
} FitTry;

typedef struct FitLadder {
    int count, best; /* best: its place, -1: none is within */
    bool full;       /* there was no room for more */
    FitTry tries[FIT_TRIES];
} FitLadder;

/* False where `run` or `repeat` said so; the ladder has what was tried until then. */
bool fit_search(const FitSpace *space, const FitGoal *goal, FitLadder *ladder);

/* The try that misses the goal least; -1: all broke. */
int fit_nearest(const FitLadder *ladder, const FitGoal *goal);

#endif
