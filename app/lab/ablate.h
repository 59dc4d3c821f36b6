/* Counts instructions of a solver step with valgrind: the same in each run, however busy the machine. */
#ifndef APP_LAB_ABLATE_H
#define APP_LAB_ABLATE_H

#include "app/lab/error_chart.h"
#include "app/scene/scene.h"

/* `slosh bench --ablate`: the cost of each term of a scene, and the change of the scene without the term.
   Each round runs the whole scene, then the scene once without each term. Times are compared within a
   round, so that other load of the machine cancels out. From round to round the whole scene's particles
   move by a millionth of a spacing, to measure the spread of repeats (like the floor of `slosh chart`). */

enum { ABLATE_ROUNDS = 3, ABLATE_RUNS = ABLATE_ROUNDS + 1 };

/* A scene, whole or without one term. */
typedef struct AblateRow {
    char term[TERM_SIZE], value[TERM_SIZE]; /* "": the whole scene */
    const char *off;                        /* value of the setting without the term; NULL: the whole scene */
    int runs;                               /* count of timed runs; of the whole scene one more */
    double ms_step[ABLATE_RUNS];            /* computing time per step of each run, ms */
    double seconds[ABLATE_RUNS]; /* computing time per simulated second, s: steps may be longer without a
                                    term */
    double steps;                /* per simulated second, in the first run */
    double instructions;         /* per step; NaN: not counted */
    double change;               /* distance of the metrics from the whole scene's; NaN: unknown */
    Outcome outcome;             /* of the first run */
} AblateRow;

typedef struct Ablation {
    const char *scene;
    char method[NAME_SIZE], backend[NAME_SIZE], renderer[256]; /* "" without a GL context */
    size_t particles;                                          /* at the start */
    double time;                                               /* simulated time of each run, s */
    int count;                                                 /* rows; the first is the whole scene */
    AblateRow row[TERMS_MAX + 1];
    double floor;          /* greatest distance between two repeats of the whole scene; NaN: unknown */
    char not_counted[256]; /* why no instructions were counted; "" if counted */
    size_t counted_particles;
} Ablation;

typedef struct AblateSetup {
    const char *scene;             /* name for scene_load */
    const SceneSettings *settings; /* of the command line */
    double time;                   /* simulated in each run, s */
    bool quiet;
} AblateSetup;

/* Makes all runs. After a signal, ends early with the rows so far. A run that breaks without a term is a
   row with its outcome. Returns false with the reason if the scene cannot be read, or breaks unchanged. A
   scene on a GPU needs a current context. `ablation` is filled in either case. */
bool ablate(const AblateSetup *setup, Ablation *ablation, Error *error);

/* Medians over the runs: ms per step, s per simulated second; NaN without runs. */
double ablate_ms_step(const AblateRow *row);

/* ablate_saved: a term's fraction of the whole scene's time, median over the rounds. ablate_noise: the
   greatest difference between rounds of the term. NaN: unknown. */
double ablate_saved(const Ablation *ablation, int row);
double ablate_noise(const Ablation *ablation, int row);

/* A term has a cost if its fraction of the time exceeds the difference between rounds. As a busy machine
   hides much, this fraction of the instructions is enough, too. */
#define ABLATE_COUNTED 0.02

/* Smaller changes of the metrics are not reported, however close the repeats are: fluid from emitters is
   the same in each repeat. */
#define ABLATE_LEAST 1e-4

/* Advice on a term, from the figures above alone. X(ENUM, word, help) */
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

/* Reports of `slosh bench --ablate`: a table, JSON. */

/* Prints one line per term, and a legend below. */
void ablate_print(const Ablation *ablation, FILE *file);

/* Writes an array: for each scene the whole scene, then one row per term; unknown values are null. Returns
   false with the reason if the file can't be written. */
bool ablate_write_json(const Ablation *ablations, size_t count, const char *path, Error *error);

#endif
