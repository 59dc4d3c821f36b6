#include "app/lab/fit.h"

#include <math.h>
#include <stddef.h>

typedef struct FitState {
    const FitSpace *space;
    const FitGoal *goal;
    FitLadder *ladder;
    int rungs;    /* index of the ladder's axis */
    bool stopped; /* by a callback */
} FitState;

static bool same_line(const FitSpace *space, const FitPoint *a, const FitPoint *b)
{
    for (int x = 0; x < space->axes; x++)
        if (space->axis[x].kind == FIT_LINE && a->at[x] != b->at[x])
            return false;
    return true;
}

static int differing(const FitSpace *space, const FitPoint *a, const FitPoint *b)
{
    int count = 0;
    for (int x = 0; x < space->axes; x++)
        count += a->at[x] != b->at[x];
    return count;
}

static FitTry *find(const FitState *search, const FitPoint *point)
{
    for (int i = 0; i < search->ladder->count; i++)
        if (differing(search->space, &search->ladder->tries[i].point, point) == 0)
            return &search->ladder->tries[i];
    return NULL;
}

/* ---- comparing tries ---- */

static bool wants_cheap(const FitGoal *goal)
{
    return isinf(goal->cost);
}

/* Greatest error, including repeats. */
static double error_of(const FitTry *try)
{
    return fmax(try->figures.error, try->worst); /* fmax skips NaN */
}

/* Bounded quantity over its bound; at most 1 is within. */
static double excess(const FitGoal *goal, const FitTry *try)
{
    return wants_cheap(goal) ? error_of(try) / goal->error : try->figures.cost / goal->cost;
}

static double value(const FitGoal *goal, const FitTry *try)
{
    return wants_cheap(goal) ? try->figures.cost : error_of(try);
}

static bool sound(const FitTry *try)
{
    return try->fate != FIT_PRUNED && try->figures.holds && isfinite(try->figures.cost) &&
           isfinite(try->figures.error);
}

static bool within(const FitState *search, const FitTry *try)
{
    return sound(try) && excess(search->goal, try) <= 1 && try->fate != FIT_LUCK;
}

/* Value to minimise. Outside the bound, the value extrapolated along the ladder to the bound: errors grow
   with the spacing, costs fall with a power of the spacing. */
static double merit(const FitState *search, const FitTry *try)
{
    const FitGoal *goal = search->goal;
    if (!sound(try))
        return INFINITY;
    const double power = wants_cheap(goal) ? search->space->power : 1 / search->space->power;
    return value(goal, try) * pow(fmax(excess(goal, try), 1), power);
}

/* Among tries with equal errors, within `scatter`, takes the cheapest. */
static void prefer_cheap(FitState *search)
{
    FitLadder *ladder = search->ladder;
    if (ladder->best < 0 || wants_cheap(search->goal))
        return;
    const double error = error_of(&ladder->tries[ladder->best]) + search->space->scatter;
    for (int i = 0; i < ladder->count; i++) {
        const FitTry *try = &ladder->tries[i];
        if (within(search, try) && error_of(try) <= error &&
            try->figures.cost < ladder->tries[ladder->best].figures.cost)
            ladder->best = i;
    }
}

static void choose(FitState *search)
{
    FitLadder *ladder = search->ladder;
    ladder->best = -1;
    for (int i = 0; i < ladder->count; i++) {
        FitTry *try = &ladder->tries[i];
        if (try->fate == FIT_BEST)
            try->fate = FIT_WITHIN;
        if (within(search, try) &&
            (ladder->best < 0 ||
             value(search->goal, try) < value(search->goal, &ladder->tries[ladder->best])))
            ladder->best = i;
    }
    prefer_cheap(search);
    if (ladder->best >= 0)
        ladder->tries[ladder->best].fate = FIT_BEST;
}

/* ---- one setting ---- */

/* Predicts the cost from the nearest finished try of the same line; from several, the least. NaN: no such
   try. */
static double predict(const FitState *search, const FitPoint *point)
{
    const FitSpace *space = search->space;
    double cost = (double)NAN;
    int least = FIT_AXES + 1;
    for (int i = 0; i < search->ladder->count; i++) {
        const FitTry *try = &search->ladder->tries[i];
        const int off = differing(space, &try->point, point);
        if (try->fate == FIT_PRUNED || !isfinite(try->figures.cost) || off > least ||
            !same_line(space, &try->point, point))
            continue;
        const double by =
            try->figures.cost * space->work(space->of, point) / space->work(space->of, &try->point);
        cost = off < least || !(cost < by) ? by : cost;
        least = off;
    }
    return cost;
}

/* Greatest allowed predicted cost of a run. */
static double ceiling(const FitState *search)
{
    const FitLadder *ladder = search->ladder;
    if (!wants_cheap(search->goal))
        return FIT_MARGIN * search->goal->cost;
    return ladder->best < 0 ? INFINITY : FIT_MARGIN * ladder->tries[ladder->best].figures.cost;
}

static FitTry *add(FitState *search, const FitPoint *point, double predicted)
{
    FitLadder *ladder = search->ladder;
    FitTry *try = &ladder->tries[ladder->count++];
    *try = (FitTry){.point = *point,
                    .predicted = predicted,
                    .worst = (double)NAN,
                    .finer = (double)NAN,
                    .fate = FIT_PRUNED,
                    .figures = {(double)NAN, (double)NAN, false, -1}};
    return try;
}

static bool run(FitState *search, FitTry *try)
{
    const FitSpace *space = search->space;
    if (!space->run(space->of, &try->point, try->predicted, &try->figures)) {
        search->stopped = true;
        search->ladder->count--; /* remove the unfinished try */
        return false;
    }
    try->fate = FIT_BROKE;
    if (sound(try))
        try->fate = within(search, try) ? FIT_WITHIN : FIT_BEYOND;
    choose(search);
    return true;
}

/* Returns the try of a setting, running it if needed. NULL: no such setting, or the search ends. Pruned
   settings are checked again, as the ceiling may have grown. */
static FitTry *ask(FitState *search, const FitPoint *point, bool always)
{
    const FitSpace *space = search->space;
    FitTry *try = find(search, point);
    if (search->stopped || (try && try->fate != FIT_PRUNED))
        return search->stopped ? NULL : try;
    if (!try && search->ladder->count == FIT_TRIES) {
        search->ladder->full = true;
        return NULL;
    }
    if (!try && !space->exists(space->of, point))
        return NULL;
    const double predicted = predict(search, point);
    const bool dear = !always && predicted > ceiling(search);
    if (!try)
        try = add(search, point, predicted);
    else if (!dear) { /* keep tries in the order of their runs */
        const FitTry again = *try;
        FitTry *last = &search->ladder->tries[search->ladder->count - 1];
        for (; try < last; try++)
            *try = try[1];
        *last = again;
        choose(search);
    }
    try->predicted = predicted;
    return dear || run(search, try) ?
    try : NULL
        ;
}

/* ---- lines ---- */

/* Walks along a line. The first rung within an error bound is the cheapest of the line; for a cost bound,
   all affordable rungs are run. */
static void walk(FitState *search, FitPoint point)
{
    const int rungs = search->space->axis[search->rungs].values;
    for (int r = 0; r < rungs && !search->stopped; r++) {
        point.at[search->rungs] = r;
        const FitTry *try = ask(search, &point, false);
        if (try && (try->fate == FIT_PRUNED || (wants_cheap(search->goal) && within(search, try))))
            break;
    }
}

static FitPoint own(const FitSpace *space)
{
    FitPoint point = {{0}};
    for (int x = 0; x < space->axes; x++)
        point.at[x] = space->axis[x].own;
    return point;
}

/* Advances like an odometer; returns false after the last line. */
static bool next_line(const FitSpace *space, FitPoint *point)
{
    for (int x = 0; x < space->axes; x++) {
        if (space->axis[x].kind != FIT_LINE)
            continue;
        if (++point->at[x] < space->axis[x].values)
            return true;
        point->at[x] = 0;
    }
    return false;
}

static FitPoint first_line(const FitSpace *space)
{
    FitPoint point = own(space);
    for (int x = 0; x < space->axes; x++)
        point.at[x] = space->axis[x].kind == FIT_LINE ? 0 : point.at[x];
    return point;
}

/* ---- columns ---- */

/* Returns the next place reached by one step from `from`, after `to` (-1: start); -1: no more. */
static int next_place(const FitAxis *axis, int from, int to)
{
    for (to++; axis->kind != FIT_LINE && axis->kind != FIT_LADDER && to < axis->values; to++)
        if (to != from && (axis->kind == FIT_FREE || to == from - 1 || to == from + 1))
            return to;
    return -1;
}

/* Returns the finest rung with an acceptable predicted cost, for a line with a finished run. */
static int finest(const FitState *search, FitPoint point)
{
    int rung = search->space->axis[search->rungs].values - 1;
    for (; rung > 0; rung--) {
        point.at[search->rungs] = rung;
        if (predict(search, &point) <= ceiling(search))
            break;
    }
    return rung;
}

/* Runs a column from fine to coarse, starting at the finest affordable rung. Errors grow with the spacing:
   with an error bound, stops at the first sound rung outside the bound; with a cost bound, at the first
   rung within. Leaves the rung of least merit in `column`, and returns the merit. */
static double try_column(FitState *search, FitPoint *column)
{
    double least = INFINITY;
    FitPoint point = *column;
    for (int rung = finest(search, point); rung >= 0 && !search->stopped; rung--) {
        point.at[search->rungs] = rung;
        const FitTry *try = ask(search, &point, false);
        if (!try || try->fate == FIT_PRUNED)
            break;
        const double found = merit(search, try);
        if (found < least) {
            least = found;
            *column = point;
        }
        const bool good = within(search, try);
        if (wants_cheap(search->goal) ? !good && isfinite(found) : good)
            break;
    }
    return least;
}

/* Steps are combined in pairs if each alone is at most so many times worse. */
static const double PAIR_REACH = 2;

/* Least gain of a step, a fraction, to continue the search from there. */
static const double GAIN = 0.02;

typedef struct Steps {
    int count;
    int axis[FIT_AXES * FIT_VALUES], place[FIT_AXES * FIT_VALUES];
} Steps;

/* Tries columns one step away along each axis; moves to the best. Steps not much worse go into `near`. */
static bool step_singles(FitState *search, FitPoint *at, Steps *near)
{
    const FitSpace *space = search->space;
    const FitPoint from = *at;
    double here = merit(search, find(search, at));
    const double before = here;
    near->count = 0;
    for (int x = 0; x < space->axes; x++)
        for (int v = -1; (v = next_place(&space->axis[x], from.at[x], v)) >= 0 && !search->stopped;) {
            FitPoint to = from;
            to.at[x] = v;
            const double there = try_column(search, &to);
            if (there < PAIR_REACH * before) {
                near->axis[near->count] = x;
                near->place[near->count++] = v;
            }
            if (there < here) {
                here = there;
                *at = to;
            }
        }
    return here < (1 - GAIN) * before;
}

/* Tries pairs of those steps. */
static bool step_pairs(FitState *search, FitPoint *at, const Steps *near)
{
    const FitPoint from = *at;
    double here = merit(search, find(search, at));
    const double before = here;
    for (int a = 0; a < near->count; a++)
        for (int b = a + 1; b < near->count && !search->stopped; b++) {
            FitPoint to = from;
            if (near->axis[a] == near->axis[b])
                continue;
            to.at[near->axis[a]] = near->place[a];
            to.at[near->axis[b]] = near->place[b];
            const double there = try_column(search, &to);
            if (there < here) {
                here = there;
                *at = to;
            }
        }
    return here < (1 - GAIN) * before;
}

static void descend(FitState *search, FitPoint at, bool pairs)
{
    Steps near;
    do
        while (step_singles(search, &at, &near) && !search->stopped) {
        }
    while (pairs && !search->stopped && step_pairs(search, &at, &near));
}

/* ---- the whole search ---- */

/* Returns the best try of the line; NULL: none is sound. */
static const FitTry *best_of_line(const FitState *search, const FitPoint *line)
{
    const FitTry *best = NULL;
    for (int i = 0; i < search->ladder->count; i++) {
        const FitTry *try = &search->ladder->tries[i];
        if (same_line(search->space, &try->point, line) &&
            merit(search, try) < (best ? merit(search, best) : INFINITY))
            best = try;
    }
    return best;
}

static double best_merit(const FitState *search)
{
    double best = INFINITY;
    for (int i = 0; i < search->ladder->count; i++)
        best = fmin(best, merit(search, &search->ladder->tries[i]));
    return best;
}

/* Greatest ratio of a line's merit to the best merit for a search along other axes: steps gain far less. */
static double reach(const FitState *search)
{
    enum { MOST = 8 };
    return wants_cheap(search->goal) ? MOST : pow(MOST, 1 / search->space->power);
}

/* Walks along a line. If all runs broke, the steps may be too long: repeats with the first places of
   ordered axes. */
static void walk_line(FitState *search, FitPoint line)
{
    walk(search, line);
    if (best_of_line(search, &line))
        return;
    for (int x = 0; x < search->space->axes; x++)
        line.at[x] = search->space->axis[x].kind == FIT_ORDERED ? 0 : line.at[x];
    walk(search, line);
}

static void search_lines(FitState *search)
{
    FitPoint line = first_line(search->space);
    do
        walk_line(search, line);
    while (!search->stopped && next_line(search->space, &line));
    line = first_line(search->space);
    do {
        const FitTry *best = best_of_line(search, &line);
        if (best && merit(search, best) <= reach(search) * best_merit(search))
            descend(search, best->point, false);
    } while (!search->stopped && next_line(search->space, &line));
}

/* Searches from the try of least merit, possibly outside the bound, and from the best. */
static void search_best(FitState *search)
{
    FitLadder *ladder = search->ladder;
    int from = -1;
    for (int i = 0; i < ladder->count; i++)
        if (isfinite(merit(search, &ladder->tries[i])) &&
            (from < 0 || merit(search, &ladder->tries[i]) < merit(search, &ladder->tries[from])))
            from = i;
    if (from >= 0)
        descend(search, ladder->tries[from].point, true);
    if (ladder->best >= 0 && !search->stopped)
        descend(search, ladder->tries[ladder->best].point, true);
}

/* NULL: no try is within the bound. */
static FitTry *best_try(const FitState *search)
{
    return search->ladder->best < 0 ? NULL : &search->ladder->tries[search->ladder->best];
}

/* Runs the next finer rung of the best. Returns false if the finer rung is outside the bound on the error:
   the best is rejected. A broken rung proves nothing. */
static bool confirm_finer(FitState *search)
{
    FitPoint finer = best_try(search)->point;
    if (!wants_cheap(search->goal) || !isnan(best_try(search)->finer) ||
        ++finer.at[search->rungs] == search->space->axis[search->rungs].values)
        return true;
    const FitPoint point = best_try(search)->point;
    const FitTry *there = ask(search, &finer, true);
    const bool luck = there && sound(there) && error_of(there) > search->goal->error;
    FitTry *best = find(search, &point); /* tries may have moved */
    best->finer = there ? there->figures.error : (double)NAN;
    if (luck)
        best->fate = FIT_LUCK;
    choose(search);
    return best->fate == FIT_BEST;
}

/* Checks the best try. Returns false if the best is rejected. */
static bool confirm(FitState *search)
{
    const FitSpace *space = search->space;
    bool holds = true;
    if (!best_try(search))
        return true;
    if (!confirm_finer(search))
        return false;
    FitTry *best = best_try(search);
    if (search->stopped || !space->repeat || !isnan(best->worst))
        return true;
    if (!space->repeat(space->of, &best->point, &best->figures, &best->worst, &holds)) {
        best->worst = (double)NAN;
        search->stopped = true;
        return true;
    }
    best->figures.holds = holds;
    if (!within(search, best))
        best->fate = FIT_REPEAT;
    choose(search);
    return best->fate == FIT_BEST;
}

bool fit_search(const FitSpace *space, const FitGoal *goal, FitLadder *ladder)
{
    FitState search = {.space = space, .goal = goal, .ladder = ladder};
    ladder->count = 0;
    ladder->full = false;
    ladder->best = -1;
    while (space->axis[search.rungs].kind != FIT_LADDER)
        search.rungs++;
    const FitPoint start = own(space);
    if (!ask(&search, &start, true) && search.stopped)
        return false;
    search_lines(&search);
    do
        search_best(&search);
    while (!search.stopped && !confirm(&search));
    return !search.stopped;
}

int fit_closest(const FitLadder *ladder, const FitGoal *goal)
{
    int nearest = -1;
    for (int i = 0; i < ladder->count; i++) {
        const FitTry *try = &ladder->tries[i];
        if (sound(try) && (nearest < 0 || excess(goal, try) < excess(goal, &ladder->tries[nearest])))
            nearest = i;
    }
    return nearest;
}
