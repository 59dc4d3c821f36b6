/* A scene and its world, as `run` and `render` open and advance them. */
#ifndef SLOSH_SESSION_H
#define SLOSH_SESSION_H

#include "app/base/exit_code.h"
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

/* What of the sentinel was told: each kind of trouble with each halving once. */
typedef struct TroubleTold {
    unsigned count;                        /* of a world's troubles, that were seen */
    unsigned halvings[STEP_TROUBLE_COUNT]; /* bit n: with 1 / 2^n of the step */
} TroubleTold;

typedef struct Session {
    Scene scene;
    char prefix[160];  /* of its messages among those of others, "particles 2000: "; "": none */
    Headless *context; /* current; NULL where neither solver nor pictures need one */
    bool borrows;      /* the context is another session's, which closes it */
    World *world;
    HandReplay *hand; /* of --device: moves the box before each step; NULL: none */
    WorldInfo info;   /* of the present state */
    double began_ms;  /* wall time of the start */
    TroubleTold told_trouble;
    bool told_full;       /* that emitters wait */
    uint64_t told_barred; /* gates of emitters, that they find no room */
    bool told_lost;       /* that particles find no place in the grid */
    bool told_unlisted;
    FluidWatch watch;
} Session;

/* Loads the only scene of the command line and the recording of --device, says on standard error what
   --particles did to dt, makes the world, and a context where its backend needs one; nothing is drawn.
   Creates no file. With --resume the world begins as its file does, where tables would say how (app/scene/
   tables.h): they may be gone. 0 or the exit code: EXIT_USAGE where the command line or the scene is wrong,
   EXIT_FAILED where the GPU can't. */
int session_open(Session *session, const Args *args, Error *error);

/* The same for a scene that is loaded, and draws. Several sessions in one process have one context: the first
   one makes it (NULL) and is to be closed last. `name`: of this one among them, or "". */
int session_open_scene(Session *session, const Args *args, const Scene *scene, const char *name,
                       Headless *context, Error *error);

/* Makes context and world of session->scene: the second half of session_open. `gpu` as of headless_create;
   `draws`: a context is needed whatever the backend. */
int session_start(Session *session, int gpu, bool draws, Error *error);

void session_close(Session *session);

/* Whether the present state is the first sound one at or after `time` (s) or a later one. */
bool session_reached(const Session *session, double time);

/* One frame on, what the sentinel did said on standard error; false when the simulation broke. */
bool session_step(Session *session, Error *error);
bool session_substep(Session *session, Error *error); /* one step of a frame */

/* Says on standard error where `what`, one each `interval` s for `span` s, will be at uneven times: mode
   fixed, and a frame that does not divide the interval, by so much that it shows in that time. */
void session_tell_uneven(const Session *session, const char *what, double interval, double span);

/* Whether there is trouble that was not told yet; it is then. */
bool session_trouble_is_new(TroubleTold *told, const WorldTrouble *trouble);

/* What the sentinel did, in words. */
const char *session_trouble_text(const WorldTrouble *trouble, char words[256]);

/* That emitters wait, in words. */
const char *session_full_text(const WorldInfo *info, char words[256]);

/* The same of emitters that find no room, but for those of `told`, which gets them. */
const char *session_barred_text(const WorldInfo *info, uint64_t *told, char words[256]);

/* That particles find no place in the grid, in words. */
const char *session_lost_text(const WorldInfo *info, char words[256]);

/* That there is no memory for what makes steps fast, in words. */
const char *session_unlisted_text(const WorldInfo *info, char words[256]);

/* What a command says when it is done, on standard error and in --json FILE. */
typedef struct Summary {
    const char *command;
    const char *product; /* "snapshots" or "pictures" */
    size_t products;
    const char *renderer;                  /* NULL: nothing was drawn */
    double step_seconds;                   /* wall time of the steps alone; 0: not measured */
    const CompressionFigures *compression; /* of the states that were looked at; NULL: none */
    const struct ForcesLog *forces;        /* NULL: they were not asked for */
    const struct ProbeTable *probes;       /* the same */
    bool stopped;                          /* by a signal */
} Summary;

/* The closing line, unless quiet, and the line about a signal. */
void session_report(const Session *session, const Args *args, const Summary *summary);

/* Of it what is of the steps alone, with the session's name before each line. */
void session_report_steps(const Session *session, const Args *args);

/* What session_write_json writes. NULL: no memory. */
json_t *session_json(const Session *session, const Args *args, const Summary *summary);

/* Writes --json FILE, if asked for. */
bool session_write_json(const Session *session, const Args *args, const Summary *summary, Error *error);

/* Says what failed, and writes --json FILE, if asked for, with as much as there is and that as "error".
   Returns EXIT_FAILED. */
int session_fail(const Session *session, const Args *args, const Summary *summary, const Error *error);

#endif
