/* The search for the largest stable step, independent of how trials are made. Steps lie on a ladder with
   STABLE_RUNGS rungs per factor of two. All searches use the same ladder, so that no trial depends on the
   number of processes. */
#ifndef SLOSH_STABLE_SEARCH_H
#define SLOSH_STABLE_SEARCH_H

#include "app/run/measure/outcome.h"

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

#endif
