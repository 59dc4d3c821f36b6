/* `slosh bench --ablate`: what each term of a scene costs, and what the scene is like without it. The scene
   is run whole, then once without each of its terms, then all of them again: times are compared within a
   round, so that what else the machine does falls out. From round to round the whole scene's particles are
   moved by a millionth of a spacing, which says how far repeats of a run lie apart (as the floor of `slosh
   chart`). */
#ifndef SLOSH_ABLATE_H
#define SLOSH_ABLATE_H

#include "app/ablate/instructions.h"
#include "app/lab/chart_row.h"
#include "app/term/term.h"

enum { ABLATE_ROUNDS = 3, ABLATE_RUNS = ABLATE_ROUNDS + 1 };

/* A scene, whole or without a term. */
typedef struct AblateRow {
    char term[TERM_SIZE], value[TERM_SIZE]; /* "": the whole scene */
    const char *off;                        /* its value without the term; NULL: the whole scene */
    int runs;                               /* that there are times of; of a whole scene one more */
    double ms_step[ABLATE_RUNS];            /* of computing, of each run, ms */
    double seconds[ABLATE_RUNS]; /* the same, s a simulated second: steps may be longer without a term */
    double steps;                /* a simulated second, of the first run */
    double instructions;         /* a step; NaN: not counted */
    double change;               /* distance of the metrics from those of the whole scene; NaN: not known */
    Outcome outcome;             /* of the first run */
} AblateRow;

typedef struct Ablation {
    const char *scene;
    char method[NAME_SIZE], backend[NAME_SIZE], renderer[256]; /* "" where no context was needed */
    size_t particles;                                          /* at the start */
    double time;                                               /* s of each run */
    int count;                                                 /* rows; the first is the whole scene */
    AblateRow row[TERMS_MAX + 1];
    double floor;          /* the greatest distance of two repeats of the whole scene; NaN: not known */
    char not_counted[256]; /* why there are no instructions; "" where there are */
    size_t counted_particles;
} Ablation;

typedef struct AblateSetup {
    const char *scene;             /* as scene_load takes it */
    const SceneSettings *settings; /* of the command line */
    double time;                   /* simulated in each run, s */
    bool quiet;
} AblateSetup;

/* Runs them all; ends early when a signal came, with the rows that it has. A run that breaks without a term
   is a row with its outcome. False, with the reason, where the scene cannot be read or breaks as it is. A
   scene on a GPU needs a current context. `ablation` is filled in either case. */
bool ablate(const AblateSetup *setup, Ablation *ablation, Error *error);

/* Medians over the runs: ms a step, s a simulated second; NaN without runs. */
double ablate_ms_step(const AblateRow *row);
double ablate_seconds(const AblateRow *row);

/* What the term takes of the whole scene's time: the median over the rounds; and how far rounds of that term
   lie apart at most. NaN: not known. */
double ablate_saved(const Ablation *ablation, int row);
double ablate_noise(const Ablation *ablation, int row);

/* What of the whole scene's instructions a step goes with the term; NaN: not counted. */
double ablate_counted(const Ablation *ablation, int row);

/* A term costs something where it takes more of the time than its rounds lie apart, or, since a busy machine
   hides much, so many of the instructions (a fraction). */
#define ABLATE_COUNTED 0.02

/* Metrics that change less than that are not said to change, however alike repeats are: fluid that emitters
   send out is the same in each. */
#define ABLATE_LEAST 1e-4

/* What to make of a term, by the figures above and nothing else. X(ENUM, word, help) */
#define ABLATE_ADVICE(X)                                                                                     \
    X(UNKNOWN, "not known", "it has not been run often enough")                                              \
    X(DROP, "drop it", "it costs something, and without it the metrics change no more than by repeats")      \
    X(IDLE, "of no account", "it costs nothing that is seen, and changes no more than repeats do")           \
    X(KEEP, "keep it", "it costs nothing that is seen, and the metrics change without it")                   \
    X(WEIGH, "weigh it", "it costs something, and the metrics change without it")                            \
    X(NEEDED, "needed", "without it the run fails")

typedef enum AblateAdvice {
#define X(NAME, word, help) ABLATE_##NAME,
    ABLATE_ADVICE(X)
#undef X
        ABLATE_ADVICE_COUNT
} AblateAdvice;

AblateAdvice ablate_advice(const Ablation *ablation, int row);
const char *ablate_advice_word(AblateAdvice advice);
const char *ablate_advice_help(AblateAdvice advice);

#endif
