/* The search for the largest step that holds: pure, whatever makes the trials. Steps stand on a ladder,
   STABLE_RUNGS rungs to a factor of two: each search of a cell tries rungs of the same one, so that no trial
   depends on how many run beside it. */
#ifndef SLOSH_STABLE_SEARCH_H
#define SLOSH_STABLE_SEARCH_H

#include "app/outcome/outcome.h"

/* STABLE_DOWN: below the first rung nothing further is tried, an eighth of the first step; STABLE_ABOVE:
   samples of what is longer than what holds; STABLE_BELOW: rungs below it where one is shorter, 0.71 times;
   STABLE_STARTS: of each trial near the limit, where chance decides. */
enum { STABLE_RUNGS = 8, STABLE_DOWN = 24, STABLE_ABOVE = 4, STABLE_BELOW = 4, STABLE_STARTS = 4 };

/* Rungs above the largest that holds where the kinds of failure are looked for: 1.09, 1.3, 1.54 and 2 times
   the step. */
extern const int stable_above[STABLE_ABOVE];

typedef struct StableFound {
    OutcomeKind kind; /* OUTCOME_NONE: not tried */
    bool silent;      /* looks found what the sentinel had not; of a `whole` trial, did not till its end */
} StableFound;

/* How a trial at that rung went, from that start; false: the search cannot go on. `whole`: what a look finds
   does not end it. */
typedef bool StableTry(void *context, int rung, int start, bool whole, StableFound *found);

typedef enum StableEnd {
    STABLE_FOUND,
    STABLE_NEVER, /* no rung holds: the lowest that was tried is `rung` */
    STABLE_ALWAYS /* all do: the highest is `rung` */
} StableEnd;

typedef struct StableSearch {
    StableEnd end;
    int rung; /* the largest that holds from all starts, as all do that were tried below */
    StableFound above[STABLE_ABOVE]; /* what is at stable_sample(), of the first start that does not hold */
    int again;                       /* the highest rung above that holds from some start; else `rung` */
} StableSearch;

/* The rung of a sample: rung + stable_above[]; of STABLE_NEVER the rungs that were tried, `rung` and upwards
   by factors of two. */
int stable_sample(const StableSearch *search, int sample);

/* The step of a rung, s, and the rung nearest to a step. */
double stable_step(int rung);
int stable_rung(double step);

/* From rung `first` up or down by factors of two until both sides are known, then by halves, from one start.
   Then down until all starts hold there and at the next rung, and one STABLE_BELOW rungs below. No rung
   above `most` is tried. False where a trial could not be made. */
bool stable_search(StableTry *attempt, void *context, int first, int most, StableSearch *search);

#endif
