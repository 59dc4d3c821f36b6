/* How a run went: what counts as each kind of failure is written down here and nowhere else. All commands
   that run a fluid say the words below in the terminal, the panel, the table and the JSON. */
#ifndef SLOSH_OUTCOME_H
#define SLOSH_OUTCOME_H

#include "sim/world/world.h"

#include <jansson.h>

/* X(ENUM, word, help): from the best to the worst; a run is of the worst kind that holds of it. */
#define OUTCOMES(X)                                                                                          \
    X(NONE, "not run", "something else than the fluid failed")                                               \
    X(HOLDS, "holds", "none of the others")                                                                  \
    X(BOILS, "boils", "neighbours move in all directions, as in a gas")                                      \
    X(NOISY, "noisy", "energy grows without work done")                                                      \
    X(FAST, "too fast", "particles are faster than sound")                                                   \
    X(SQUEEZED, "squeezed", "fluid has lost volume")                                                         \
    X(CLUMPS, "clumps", "particles lie on each other")                                                       \
    X(LEAKS, "leaks", "particles cross walls, or have no place in a grid")                                   \
    X(DIVERGES, "does not converge", "a solver ends far from what it was asked for")                         \
    X(BLOWN_UP, "blown up", "particles move too far in a step, or are pressed too hard")

typedef enum OutcomeKind {
#define X(NAME, word, help) OUTCOME_##NAME,
    OUTCOMES(X)
#undef X
        OUTCOME_COUNT
} OutcomeKind;

const char *outcome_word(OutcomeKind kind);
const char *outcome_help(OutcomeKind kind);

/* The kind of that word; OUTCOME_COUNT without one. */
OutcomeKind outcome_of_word(const char *word);

/* Energy has grown without work done where it is so much (a fraction) above the least that it was before, of
   all that moves, is pressed, or could come down. The scenes that gain most gain 2.2 % (docs/failures.md). */
#define OUTCOME_GAIN 0.05

/* Fluid in a box at rest boils where less than this part of its energy of motion is of motion together with
   neighbours, and particles jump higher than so many spacings in gravity, or are faster than so much of
   sound. Calm or splashing, scenes have a half and more. */
#define OUTCOME_TOGETHER 0.2
#define OUTCOME_JUMP     0.5
#define OUTCOME_OF_SOUND 0.05

/* Fluid has lost volume where its particles are pressed by so much above rest density in the mean. Calm
   scenes have less than 0.02 with all methods. */
#define OUTCOME_PRESSED 0.05

/* Particles lie on each other where so many of them (a fraction) have another one nearer than so many
   spacings: OUTCOME_NEAR of them more than at the start. */
#define OUTCOME_NEAR  0.2
#define OUTCOME_CLOSE 0.1

/* Fluid leaks where so many of its particles (a fraction) are beyond a wall by half a spacing, or without a
   place in the grid. */
#define OUTCOME_BEYOND 0.5
#define OUTCOME_OUT    0.001

/* What a run was like at a time. */
typedef struct OutcomeLook {
    double time;  /* s */
    size_t count; /* particles */
    size_t close; /* of them, nearer than OUTCOME_NEAR spacings to another one */
    size_t
        beyond;  /* of them, by OUTCOME_BEYOND spacings beyond a wall of the box or within a solid, or nowhere
                  */
    size_t lost; /* of them, without a place in the grid */
    double pressed; /* how much of their density is above that at rest, a fraction, in the mean */
    double
        together;   /* of the energy of motion, a fraction: that of motion with neighbours; 1 of what rests */
    double jump;    /* how fast they move, in the mean, over what OUTCOME_JUMP and OUTCOME_OF_SOUND say */
    double fastest; /* greatest speed of any of them so far, m/s */
    double sound;   /* m/s; 0 without sound */
    bool stuck;     /* a solver of the last step ended in trouble */
    double energy;  /* of motion, place and compression, J; NaN: not known, or something does work */
    double scale;   /* what its growth is compared with, J */
} OutcomeLook;

enum { OUTCOME_LOOKS_MAX = 64 };

typedef struct OutcomeHistory {
    int count;
    OutcomeLook look[OUTCOME_LOOKS_MAX]; /* in the order of time */
    WorldTrouble trouble;                /* `ended`: by that trouble */
} OutcomeHistory;

enum { OUTCOME_WORDS = 192 };

typedef struct Outcome {
    OutcomeKind kind;
    double time;               /* when it was first seen, s; NaN where it holds or did not run */
    char words[OUTCOME_WORDS]; /* what was found, on one line; "" where it holds */
} Outcome;

/* The looks are some of a run's: what comes and goes between two of them is not seen. */
void outcome_judge(const OutcomeHistory *history, Outcome *outcome);

/* Of something else than the fluid that failed. */
void outcome_not_run(const char *why, Outcome *outcome);

enum { OUTCOME_TEXT = OUTCOME_WORDS + 64 };

/* "blown up at t = 0.31 s: a particle moves further than the support radius in one step"; "holds" */
const char *outcome_text(const Outcome *outcome, char text[OUTCOME_TEXT]);

/* Adds "outcome" to an object (NULL: nothing): the kind's word; and, but where it holds, "outcome_time" (s,
   or null) and "outcome_words". */
void outcome_json(json_t *object, const Outcome *outcome);

#endif
