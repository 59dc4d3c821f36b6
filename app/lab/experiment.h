/* An experiment: a command that makes many runs and reports what they show. Its trials stay in OUT.csv, so
   that the same command goes on where it was stopped. docs/add/experiment.md says how to add one. */
#ifndef APP_LAB_EXPERIMENT_H
#define APP_LAB_EXPERIMENT_H

#include "app/base/program.h"
#include "app/cli/args/args.h"
#include "app/lab/trials.h"
#include "app/run/offscreen.h"

#include <jansson.h>

typedef struct ExperimentRun ExperimentRun;

/* On failure a function returns false with the reason; then the following functions do not run. */
typedef struct Experiment {
    const TrialTable *table; /* of its trials */
    size_t size;             /* of its own state, `run->state`, which begins as zeros */

    /* Reads the command line; names the files, usually by experiment_name_files. Exit code 2 on failure. */
    bool (*plan)(ExperimentRun *run, Error *error);

    /* Checks that the output may be written; NULL: it is a chart. */
    bool (*check)(ExperimentRun *run, Error *error);

    /* Makes the trials missing in `run->file`. NULL: experiment_trials, if the plan knows the number of
       trials, `run->wanted`: by the next four functions. */
    bool (*run)(ExperimentRun *run, Error *error);

    /* Fills in the inputs and the key of trial `i`. */
    bool (*prepare)(ExperimentRun *run, int i, void *row, Error *error);

    /* Takes the results of an older run; returns false if the trial must be made again. NULL: the whole row.
     */
    bool (*take)(void *row, const void *older);

    /* Makes trial `i`. A trial with a broken fluid is a row, too. */
    bool (*make)(ExperimentRun *run, int i, void *row, const ProgressPart *part, Error *error);

    /* Estimates the time of trial `i`, in any unit; NULL: all alike. */
    double (*seconds)(const ExperimentRun *run, int i);

    /* Prints the table, unless quiet, and writes the output. */
    bool (*report)(ExperimentRun *run, Error *error);

    /* All figures, for --json; `failure`: why there is no output, or NULL. */
    json_t *(*json)(const ExperimentRun *run, const char *failure);

    /* Frees memory owned by the state; NULL: none. */
    void (*close)(ExperimentRun *run);
} Experiment;

struct ExperimentRun {
    const Experiment *of;
    const Args *args;
    void *state;
    char output[1024], csv[1024]; /* the output; the file of the trials */
    Trials file, rows;            /* all trials of the file; those of this run, in order */
    int wanted, there;            /* trials of the plan, 0: unknown; and those with results */
    bool has_figures;             /* true: `json` has something to say */
    Headless *context;            /* see experiment_context */
    bool context_named;           /* its renderer, on standard error */
};

/* Runs a command from its start to the exit code: signals, checks of all files, the trials of older runs, the
   report, the JSON, also that of a failure. */
int experiment_run(const Experiment *experiment, const Args *args);

/* Names the chart of the command line, and OUT.csv beside it. */
bool experiment_name_files(ExperimentRun *run, Error *error);

/* Makes a GL context unless there is one, and names the renderer on standard error. */
bool experiment_context(ExperimentRun *run, Error *error);

/* Makes the missing trials of the plan in turn; `run->rows` gets all trials, in order. */
bool experiment_trials(ExperimentRun *run, Error *error);

/* The settings of a run: first the settings of the command line. Contains pointers into itself: do not
   copy. */
enum { RUN_TEXTS = 24, RUN_TEXT_SIZE = 192 };

typedef struct RunSettings {
    SceneSettings all;
    int used;
    char texts[RUN_TEXTS][RUN_TEXT_SIZE];
} RunSettings;

/* Adds "KEY=VALUE", or with an option before it, "--axis KEY=VALUE", by which messages name the setting.
   Returns false if there are too many. */
__attribute__((format(printf, 3, 4))) bool run_settings_add(RunSettings *settings, Error *error,
                                                            const char *format, ...);

/* The last part of a key's path or of a setting: "viscosity=2" of "fluids[0].viscosity=2". */
const char *key_last_part(const char *path);

/* True if the key has an effect on the scene; else `why` has the reason. */
bool key_has_effect(const Scene *scene, const char *path, char why[NOTE_SIZE]);

/* Keeps a new trial in the file, unless it is no possible row. A full file drops old rows that are not in
 * `rows`. */
bool experiment_keep(ExperimentRun *run, const void *row, Error *error);

#endif
