#include "app/stability/stable_search.h"

#include <math.h>

const int stable_above[STABLE_ABOVE] = {1, 3, 5, 8};

double stable_step(int rung)
{
    return exp2((double)rung / STABLE_RUNGS);
}

int stable_rung(double step)
{
    return (int)lround(STABLE_RUNGS * log2(step));
}

/* State of a search. */
typedef struct Bracket {
    StableTry *attempt;
    void *context;
    int holds, fails;  /* rungs */
    bool held, failed; /* true if the rung is known */
    int highest;       /* rung that held from some start */
} Bracket;

/* Tries a rung from `starts` starts, until one fails. Returns the failure's outcome, else the last
   outcome. */
static bool ask(Bracket *b, int rung, int starts, bool whole, StableFound *found)
{
    for (int start = 0; start < starts; start++) {
        if (!b->attempt(b->context, rung, start, whole, found))
            return false;
        if (found->kind != OUTCOME_HOLDS)
            return true;
        b->highest = rung > b->highest ? rung : b->highest;
    }
    return true;
}

static bool try_rung(Bracket *b, int rung)
{
    StableFound found;
    if (!ask(b, rung, 1, false, &found))
        return false;
    if (found.kind == OUTCOME_HOLDS) {
        b->holds = rung;
        b->held = true;
    } else {
        b->fails = rung;
        b->failed = true;
    }
    return true;
}

/* Moves by factors of two until one rung holds and one fails, or the ends are reached. */
static bool enclose(Bracket *b, int first, int most, int lowest)
{
    bool ok = try_rung(b, first);
    while (ok && !b->failed && b->holds < most)
        ok = try_rung(b, b->holds + STABLE_RUNGS < most ? b->holds + STABLE_RUNGS : most);
    while (ok && !b->held && b->fails > lowest)
        ok = try_rung(b, b->fails - STABLE_RUNGS);
    return ok;
}

/* Moves down until chance decides no more: a rung with a failure at or below it is not accepted. */
static bool settle(Bracket *b, int lowest)
{
    static const int below[] = {0, 1, STABLE_BELOW}, starts[] = {STABLE_STARTS, STABLE_STARTS, 1};
    for (bool all = false; b->held && !all;) {
        all = true;
        const int rung = b->holds;
        for (int k = 0; all && k < 3; k++) {
            StableFound found;
            if (!ask(b, rung - below[k], starts[k], false, &found))
                return false;
            all = found.kind == OUTCOME_HOLDS;
            if (all)
                continue;
            b->fails = rung - below[k];
            b->failed = true;
            b->holds = b->fails - 1;
            b->held = b->holds >= lowest;
        }
    }
    return true;
}

int stable_sample(const StableSearch *search, int sample)
{
    return search->rung + (search->end == STABLE_NEVER ? sample * STABLE_RUNGS : stable_above[sample]);
}

/* Samples the outcomes above the largest step. */
static bool look_above(Bracket *b, int most, StableSearch *search)
{
    for (int i = 0; i < STABLE_ABOVE; i++) {
        const int rung = stable_sample(search, i);
        search->above[i] = (StableFound){.kind = OUTCOME_NONE};
        if (rung <= most && !ask(b, rung, STABLE_STARTS, search->end != STABLE_NEVER, &search->above[i]))
            return false;
    }
    search->again = b->highest > search->rung ? b->highest : search->rung;
    return true;
}

bool stable_search(StableTry *attempt, void *context, int first, int most, StableSearch *search)
{
    first = first < most ? first : most;
    const int lowest = first - STABLE_DOWN;
    Bracket b = {.attempt = attempt, .context = context, .highest = lowest - 1};
    bool ok = enclose(&b, first, most, lowest);
    while (ok && b.held && b.failed && b.fails > b.holds + 1)
        ok = try_rung(&b, b.holds + (b.fails - b.holds) / 2);
    if (!ok || !settle(&b, lowest))
        return false;
    search->end = !b.held ? STABLE_NEVER : !b.failed ? STABLE_ALWAYS : STABLE_FOUND;
    search->rung = b.held ? b.holds : b.fails;
    return look_above(&b, most, search);
}
