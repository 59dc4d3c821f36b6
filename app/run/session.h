/* A session: a scene and its world without a window, as opened and advanced by `run` and `render`, with the
   outputs of a run: snapshots, probes, figures; and recorded sessions played back. */
#ifndef APP_RUN_SESSION_H
#define APP_RUN_SESSION_H

#include "app/base/program.h"
#include "app/cli/args/args.h"
#include "app/files/snapshot.h"
#include "app/input/input.h"
#include "app/run/measure/measure.h"
#include "app/run/offscreen.h"
#include "app/run/recording/recording.h"
#include "app/run/run.h"
#include "app/scene/scene.h"
#include "sim/error.h"
#include "sim/world.h"

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>

/* A scene and its world, as opened and advanced by `run` and `render`. */

typedef struct Session {
    Run run;            /* on ranks all functions with a Session are collective, and the first prints */
    char prefix[160];   /* prefix of messages in a group of sessions, "particles 2000: "; "": none */
    Headless *context;  /* current; NULL if neither solver nor pictures need a context */
    bool borrows;       /* the context belongs to a different session, which closes it */
    DeviceReplay *hand; /* of --device: moves the box before each step; NULL: none */
    double began_ms;    /* wall time of the start */
} Session;

/* Opens the session: loads the command line's only scene and the recording of --device, and reports the
   effect of --particles on dt on standard error. Makes the world, and a context if the backend needs one;
   draws nothing and creates no file. With `resume` the world starts from its file even where tables give the
   start (app/scene/scene.h), as tables may be gone. Returns 0 or the exit code: EXIT_USAGE for a wrong
   command line or scene, EXIT_FAILED for a failing GPU. */
int session_open(Session *session, const Args *args, bool resume, Error *error);

/* Opens a session for drawing a loaded scene. Several sessions in a process share a context: the first
   session creates the context (NULL), and must be closed last. `name`: the session's name in the group, or
   "". */
int session_open_scene(Session *session, const Args *args, const Scene *scene, const char *name,
                       Headless *context, Error *error);

/* Makes context and world of session->run.scene: the second half of session_open. `gpu` as of
   headless_create; `draws`: needs a context for any backend. */
int session_start(Session *session, int gpu, bool draws, Error *error);

void session_close(Session *session);

/* True if the present state is sound and at or after `time` (s). */
bool session_reached(const Session *session, double time);

/* Advances one frame and reports the sentinel's actions on standard error. Returns false if the simulation
   broke. */
bool session_step(Session *session, Error *error);
bool session_substep(Session *session, Error *error); /* one step of a frame */

/* True after a signal to stop, on ranks to any rank. */
bool session_interrupted(const Session *session);

/* Warns on standard error if `what`, one per `interval` s for `span` s, will be at uneven times. Only in mode
   fixed, if the frame does not divide the interval and the error shows within the span. */
void session_warn_uneven(const Session *session, const char *what, double interval, double span);

/* Final figures of a command, for standard error and --json FILE. */
typedef struct Summary {
    const char *command;
    const char *product; /* "snapshots" or "pictures" */
    size_t products;
    const char *renderer;                  /* NULL: nothing was drawn */
    double late;                           /* greatest delay of a state after the time of its picture, s */
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

/* Step limits and figures of iterative solvers over a run (WorldInfo.limited and solved), for JSON and for
   people: the only place with these names. */

/* Adds iterations_mean, iterations_p95, density_error_mean and density_error_max to an object, and with
   implicit viscosity viscosity_iterations_mean and viscosity_residual_mean. Adds nothing for a world without
   such solvers. */
void solve_figures_json(json_t *object, const SolveFigures *solved);

enum { SOLVE_FIGURES_WORDS = 192 };

/* "8.3 iterations a step (p95 14), density error 0.048 % mean, 1.2 % max"; "" for other methods. */
const char *solve_figures_text(const SolveFigures *solved, char words[SOLVE_FIGURES_WORDS]);

/* {"courant": 120, "growth": 10}: count of steps for each limit with any. */
json_t *step_limits_json(const uint64_t limited[STEP_LIMIT_COUNT]);

enum { STEP_LIMITS_WORDS = 192 };

/* "courant 92.3 % growth 7.7 %". */
const char *step_limits_text(const uint64_t limited[STEP_LIMIT_COUNT], char words[STEP_LIMITS_WORDS]);

/* The probes of a session, read after each step: output of `slosh run --probes`. */

/* Zero-initialise before use. */
typedef struct ProbeSeries {
    ProbeTable table;
    unsigned troubles; /* count of the world's troubles at the last row */
    Forces forces;     /* if a probe measures a force: summed since the last probe_series_forces */
} ProbeSeries;

/* Opens the run's probes, and the table at `path`. New tables start with a row of the present state;
   `resumed` tables continue after their rows up to now. A NULL path means no table. Returns false with the
   reason. */
bool probe_series_begin(ProbeSeries *series, Session *session, const char *path, bool resumed, Error *error);

/* Call after each step of a frame: reads a row, or drops the rows of a frame that the world has taken
   back. */
bool probe_series_step(ProbeSeries *series, Session *session, Error *error);

/* Forces since the last call, as from world_forces. While a probe measures a force, call this function
   instead of world_forces. */
void probe_series_forces(ProbeSeries *series, Session *session, Forces *forces);

/* Writes the frame's rows to the file at the end of a frame. On a GPU waits for the frame. */
bool probe_series_frame(ProbeSeries *series, const Session *session, Error *error);

/* Close the table but keep the figures; then free all, before session_close. */
bool probe_series_close(ProbeSeries *series, Error *error);
void probe_series_free(ProbeSeries *series);

/* Snapshots of a session at regular times: output of `run` and `replay`. */

typedef struct SnapshotSeries {
    SnapshotWriter *file; /* not owned; NULL: no snapshots */
    double every;         /* s, more than 0 */
    double next;          /* next due multiple of `every` */
} SnapshotSeries;

/* Appends the present state if it is the first at or after the due multiple of `every`. Returns false with
   the reason if writing fails. */
bool snapshot_series_add(SnapshotSeries *series, const Session *session, Error *error);

/* After a failure: reports the whole snapshots in `path` on standard error. NULL is allowed. */
void snapshot_series_report_left(const SnapshotWriter *file, const char *path);

/* True if `path` is a valid name for snapshots, FILE.h5part: ParaView finds the format by this suffix. */
bool snapshot_series_check_name(const char *path, Error *error);

/* Continues after the present state, which the file already has. */
void snapshot_series_resume(SnapshotSeries *series, const Session *session);

/* Plays back a recorded session by simulating it again. */

typedef struct RecordingPlay {
    const char *path; /* of the recording, for messages */
    const Recording *recording;
    size_t next; /* index of the next command */
} RecordingPlay;

/* True if the command line's settings leave the session's bits unchanged; otherwise the error names the
   culprit. */
bool recording_play_allows(const char *path, const SceneSettings *more, Error *error);

/* Makes the recording's scene with the recorded settings, then the settings of `more`; `notes` as of
   scene_parse. */
bool recording_play_scene(const Recording *recording, const SceneSettings *more, ScenePurpose purpose,
                          Scene *scene, Notes *notes, Error *error);

/* Loads the recording's scene as recording_play_scene (`more`: --threads; NULL: none), and makes the world;
   `gpu` and `draws` as of session_start. Returns 0, or the exit code with "path: its scene ..."; call
   session_close in any case. */
int recording_play_open(const RecordingPlay *play, const SceneSettings *more, int gpu, bool draws,
                        Session *session, Error *error);

/* Applies the commands due at the present step. Returns false with "path:line: ..." if a setting is wrong. */
bool recording_play_apply(RecordingPlay *play, Session *session, Error *error);

/* True when all recorded commands and steps are done. */
bool recording_play_ended(const RecordingPlay *play, const Session *session);

/* True if the simulation broke at the recorded breaking step. */
bool recording_play_broke(const RecordingPlay *play, const Session *session);

/* True if `hash` (of world_hash) is the recorded one. False for a cut recording, which has no hash. */
bool recording_play_same(const RecordingPlay *play, uint64_t hash);

/* Reports a recording made by a different version on standard error. */
void recording_play_warn_version(const char *path, const Recording *recording);

/* Reports the result on standard error and returns the exit code; `ended`: not stopped before the end.
   `quiet`: no message about equal bits. */
int recording_play_report(const RecordingPlay *play, const Session *session, bool ended, uint64_t hash,
                          bool quiet);

#endif
