/* Outcome of a run: the only definition of each kind of failure. All commands running a fluid report these
   words in the terminal, the panel, the table and the JSON. */
#ifndef APP_RUN_MEASURE_OUTCOME_H
#define APP_RUN_MEASURE_OUTCOME_H

#include "slosh/world.h"

#include <jansson.h>

/* X(ENUM, word, help): from best to worst; a run gets the worst applicable kind. */
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

/* Returns the kind of a word; OUTCOME_COUNT if unknown. */
OutcomeKind outcome_of_word(const char *word);

/* Energy has grown without work if the energy exceeds its earlier minimum by this fraction of the sum of
   kinetic, compression and available potential energy. The greatest gain of any scene is 2.2 %
   (docs/failures.md). */
#define OUTCOME_GAIN 0.05

/* Fluid in a box at rest boils if two conditions hold. The fraction of kinetic energy in common motion
   with neighbours is less than OUTCOME_TOGETHER. Particles jump higher than OUTCOME_JUMP spacings under
   gravity, or are faster than OUTCOME_OF_SOUND of the sound speed. Calm or splashing scenes have a
   fraction of a half and more. */
#define OUTCOME_TOGETHER 0.2
#define OUTCOME_JUMP     0.5
#define OUTCOME_OF_SOUND 0.05

/* Fluid has lost volume if the mean compression above rest density exceeds this fraction. Calm scenes have
   less than 0.02 with all methods. */
#define OUTCOME_PRESSED 0.05

/* Particles lie on each other if the fraction with a neighbour nearer than OUTCOME_NEAR spacings has grown
   by OUTCOME_CLOSE since the start. */
#define OUTCOME_NEAR  0.2
#define OUTCOME_CLOSE 0.1

/* Fluid leaks if the fraction OUTCOME_OUT of its particles is beyond a wall by OUTCOME_BEYOND spacings, or
   without a place in the grid. */
#define OUTCOME_BEYOND 0.5
#define OUTCOME_OUT    0.001

/* Properties of a run at one time. */
typedef struct OutcomeSample {
    double time;     /* s */
    size_t count;    /* particles */
    size_t close;    /* particles nearer than OUTCOME_NEAR spacings to a neighbour */
    size_t beyond;   /* particles beyond a wall of the box, or inside a solid, by OUTCOME_BEYOND spacings, or
                        at NaN */
    size_t lost;     /* particles without a place in the grid */
    double pressed;  /* mean compression above rest density, a fraction */
    double together; /* fraction of kinetic energy in common motion with neighbours; 1 at rest */
    double jump;     /* mean speed over the threshold of OUTCOME_JUMP or OUTCOME_OF_SOUND */
    double fastest;  /* greatest speed of any particle so far, m/s */
    double sound;    /* m/s; 0 without sound */
    bool stuck;      /* a solver of the last step failed to converge */
    double energy; /* kinetic, potential and compression energy, J; NaN: unknown, or external work is done */
    double scale;  /* reference for growth of energy, J */
} OutcomeSample;

enum { OUTCOME_SAMPLES_MAX = 64 };

typedef struct OutcomeHistory {
    int count;
    OutcomeSample look[OUTCOME_SAMPLES_MAX]; /* ordered by time */
    WorldTrouble trouble;                    /* `ended`: the trouble ended the run */
} OutcomeHistory;

enum { OUTCOME_WORDS = 192 };

typedef struct Outcome {
    OutcomeKind kind;
    double time;               /* time of first detection, s; NaN if the run holds or was not run */
    char words[OUTCOME_WORDS]; /* details on one line; "" if the run holds */
} Outcome;

/* Judges a run by its looks and its trouble; a failure only between two looks goes unseen. */
void outcome_judge(const OutcomeHistory *history, Outcome *outcome);

/* Makes the outcome of a failure outside the fluid. */
void outcome_not_run(const char *why, Outcome *outcome);

enum { OUTCOME_TEXT = OUTCOME_WORDS + 64 };

/* "blown up at t = 0.31 s: a particle moves further than the support radius in one step"; "holds" */
const char *outcome_text(const Outcome *outcome, char text[OUTCOME_TEXT]);

/* Adds "outcome" to an object (may be NULL): the kind's word; unless the run holds, also "outcome_time"
   (s, or null) and "outcome_words". */
void outcome_json(json_t *object, const Outcome *outcome);

/* Takes looks at a world, to judge its outcome. */

/* Adds a look at the present state, which must be sound; a full history's last look is replaced. `def`:
   definition of the world; `moved`: the box is moved by other means than the scene. Reads the particles:
   takes about ten steps' time. Returns false if memory is short. */
bool outcome_sample(OutcomeHistory *history, const WorldDef *def, bool moved, World *world);

/* Records the trouble that ended the run, if any. */
void outcome_end(OutcomeHistory *history, const World *world);

/* Watches a running fluid for failures outside the sentinel's reach: lost volume, particles lying on each
   other or beyond walls, boiling, too fast motion, slow growth of energy (app/run/measure/outcome.h). On a
   GPU each look would wait for the GPU: there only speeds are checked. */

/* Steps from one look to the next: as many as there have been so far, within these bounds. Most failing
   runs fail early; later a look, of up to two thirds of a step's time, takes less than a hundredth of the
   time. */
enum { FLUID_WATCH_STEPS = 50, FLUID_WATCH_LATER = 200, FLUID_WATCH_WORDS = OUTCOME_WORDS + 192 };

/* Zero-initialise all but `closed` and `resumed`; again whenever the scene restarts. */
typedef struct FluidWatch {
    bool closed;         /* only the scene acts, no hand, no changes: energy is checked */
    bool resumed;        /* continues from a later state: no close particles are normal */
    bool looked;         /* true after the first look */
    OutcomeSample start; /* normal values: close particles at the first look; least energy so far; remaining
                          members 0 */
    Outcome worst;       /* of all looks */
    unsigned told;       /* reported kinds: bit k stands for OutcomeKind k */
    uint64_t next;       /* step of the next look */
} FluidWatch;

/* Call after a sound step, at the end of a frame: looks if a look is due. Returns true if a kind of
   failure is found for the first time; `words` gets its word, details, and advice. Of several kinds the
   worst is reported first, the next kind at the next look. */
bool fluid_watch(FluidWatch *watch, const WorldDef *def, World *world, char words[FLUID_WATCH_WORDS]);

/* Fills in the outcome of the run, including the trouble that ended the run. Returns false if there was no
   look. */
bool fluid_watch_outcome(const FluidWatch *watch, const WorldTrouble *trouble, Outcome *outcome);

#endif
