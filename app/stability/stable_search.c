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

/* What is known on the way. */
typedef struct Bracket {
    StableTry *attempt;
    void *context;
    int holds, fails;  /* rungs; */
    bool held, failed; /* whether there is one */
} Bracket;

static bool try_rung(Bracket *b, int rung)
{
    StableFound found;
    if (!b->attempt(b->context, rung, false, &found))
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

/* By factors of two, until a rung holds and one does not, or there is no further one. */
static bool enclose(Bracket *b, int first, int most)
{
    const int lowest = first - STABLE_DOWN;
    bool ok = try_rung(b, first);
    while (ok && !b->failed && b->holds < most)
        ok = try_rung(b, b->holds + STABLE_RUNGS < most ? b->holds + STABLE_RUNGS : most);
    while (ok && !b->held && b->fails > lowest)
        ok = try_rung(b, b->fails - STABLE_RUNGS);
    return ok;
}

int stable_sample(const StableSearch *search, int sample)
{
    return search->rung + (search->end == STABLE_NEVER ? sample * STABLE_RUNGS : stable_above[sample]);
}

/* Whether what is longer fails, and what is shorter holds. */
static bool look_around(const Bracket *b, int most, StableSearch *search)
{
    search->again = search->rung;
    search->below = (StableFound){.kind = OUTCOME_NONE};
    if (search->end != STABLE_NEVER &&
        !b->attempt(b->context, search->rung - STABLE_BELOW, false, &search->below))
        return false;
    for (int i = 0; i < STABLE_ABOVE; i++) {
        const int rung = stable_sample(search, i);
        search->above[i] = (StableFound){.kind = OUTCOME_NONE};
        if (rung > most)
            continue;
        if (!b->attempt(b->context, rung, search->end != STABLE_NEVER, &search->above[i]))
            return false;
        if (search->above[i].kind == OUTCOME_HOLDS)
            search->again = rung;
    }
    return true;
}

bool stable_search(StableTry *attempt, void *context, int first, int most, StableSearch *search)
{
    Bracket b = {.attempt = attempt, .context = context};
    first = first < most ? first : most;
    bool ok = enclose(&b, first, most);
    while (ok && b.held && b.failed && b.fails > b.holds + 1)
        ok = try_rung(&b, b.holds + (b.fails - b.holds) / 2);
    if (!ok)
        return false;
    search->end = !b.held ? STABLE_NEVER : !b.failed ? STABLE_ALWAYS : STABLE_FOUND;
    search->rung = b.held ? b.holds : b.fails;
    return look_around(&b, most, search);
}
