/* A scene and its world, as opened and advanced by `run` and `render`. */
#ifndef SLOSH_SESSION_H
#define SLOSH_SESSION_H

#include "app/base/program.h"
#include "app/held/hand_replay.h"
#include "app/metric/compression.h"
#include "app/outcome/fluid_watch.h"
#include "app/scene/scene.h"
#include "app/session/args.h"
#include "app/session/headless.h"
#include "sim/base/error.h"
#include "sim/world/world.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

/* Troubles of the sentinel already reported: each kind of trouble with each halving once. */
typedef struct TroubleTold {
    unsigned count;                        /* of the world's troubles seen so far */
    unsigned halvings[STEP_TROUBLE_COUNT]; /* bit n: with 1 / 2^n of the step */
} TroubleTold;

typedef struct Session {
    Scene scene;
    char prefix[160];  /* prefix of messages in a group of sessions, "particles 2000: "; "": none */
    Headless *context; /* current; NULL if neither solver nor pictures need a context */
    bool borrows;      /* the context belongs to a different session, which closes it */
    World *world;
    HandReplay *hand; /* of --device: moves the box before each step; NULL: none */
    WorldInfo info;   /* of the present state */
    double began_ms;  /* wall time of the start */
    TroubleTold told_trouble;
    bool told_full;       /* reported: emitters wait */
    uint64_t told_barred; /* bits of emitter gates already reported as blocked */
    bool told_lost;       /* reported: particles have no cell in the grid */
    bool told_unlisted;
    FluidWatch watch;
} Session;

/* Opens the session: loads the command line's only scene and the recording of --device, and reports the
   effect of --particles on dt on standard error. Makes the world, and a context if the backend needs one;
   draws nothing and creates no file. With --resume the world starts from its file even where tables give the
   start (app/scene/scene_files.h), as tables may be gone. Returns 0 or the exit code: EXIT_USAGE for a wrong
   command line or scene, EXIT_FAILED for a failing GPU. */
int session_open(Session *session, const Args *args, Error *error);

/* Opens a session for drawing a loaded scene. Several sessions in a process share a context: the first
   session creates the context (NULL), and must be closed last. `name`: the session's name in the group, or
   "". */
int session_open_scene(Session *session, const Args *args, const Scene *scene, const char *name,
                       Headless *context, Error *error);

/* Makes context and world of session->scene: the second half of session_open. `gpu` as of headless_create;
   `draws`: needs a context for any backend. */
int session_start(Session *session, int gpu, bool draws, Error *error);

void session_close(Session *session);

/* True if the present state is sound and at or after `time` (s). */
bool session_reached(const Session *session, double time);

/* Advances one frame and reports the sentinel's actions on standard error. Returns false if the simulation
   broke. */
bool session_step(Session *session, Error *error);
bool session_substep(Session *session, Error *error); /* one step of a frame */

/* Warns on standard error if `what`, one per `interval` s for `span` s, will be at uneven times. Only in mode
   fixed, if the frame does not divide the interval and the error shows within the span. */
void session_tell_uneven(const Session *session, const char *what, double interval, double span);

/* True once per new trouble; marks the trouble as reported. */
bool session_trouble_is_new(TroubleTold *told, const WorldTrouble *trouble);

/* The sentinel's action, in words. */
const char *session_trouble_text(const WorldTrouble *trouble, char words[256]);

/* Waiting emitters, in words. */
const char *session_full_text(const WorldInfo *info, char words[256]);

/* Blocked emitters, in words, without the emitters in `told`; adds the new emitters to `told`. */
const char *session_barred_text(const WorldInfo *info, uint64_t *told, char words[256]);

/* Particles without a cell in the grid, in words. */
const char *session_lost_text(const WorldInfo *info, char words[256]);

/* Lack of memory for the data that make steps fast, in words. */
const char *session_unlisted_text(const WorldInfo *info, char words[256]);

/* Final figures of a command, for standard error and --json FILE. */
typedef struct Summary {
    const char *command;
    const char *product; /* "snapshots" or "pictures" */
    size_t products;
    const char *renderer;                  /* NULL: nothing was drawn */
    double step_seconds;                   /* wall time of the steps alone; 0: not measured */
    const CompressionFigures *compression; /* of the observed states; NULL: none */
    const struct ForcesLog *forces;        /* NULL: not requested */
    const struct ProbeTable *probes;       /* NULL: not requested */
    bool stopped;                          /* by a signal */
} Summary;

/* Prints the closing line, unless quiet, and the line about a signal. */
void session_report(const Session *session, const Args *args, const Summary *summary);

/* Prints the part about steps, with the session's name before each line. */
void session_report_steps(const Session *session, const Args *args);

/* The JSON of session_write_json; caller owns. NULL: memory is short. */
json_t *session_json(const Session *session, const Args *args, const Summary *summary);

/* Writes --json FILE, if given. */
bool session_write_json(const Session *session, const Args *args, const Summary *summary, Error *error);

/* Reports the error, and writes --json FILE, if given, with all known figures and the message as "error".
   Returns EXIT_FAILED. */
int session_fail(const Session *session, const Args *args, const Summary *summary, const Error *error);

#endif
