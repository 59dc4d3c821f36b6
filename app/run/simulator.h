/* Runs the solver at its own pace beside the view. A thread owns the World, obeys commands between two steps,
   and passes the state after each step to the upload ring. So a picture shows the newest state instead of the
   last whole frame, which answers the hand sooner by about half a frame.

   If the scene says `realtime` the pace follows the wall clock times the speed; frames that come too late are
   skipped, dt stays. Otherwise the thread runs as fast as possible. The solver never waits for the view. On a
   software driver, views open parallel regions on the window's thread too (planes, trails, layers of points).
   Then two regions run side by side, each with threads of its own. All functions here must be called from one
   thread, the window's thread.

   A GPU backend steps on the window's thread instead, where the context is: simulator_work does the due work,
   and the views read the world's own buffers.

   Following simulators step on the leader's thread, in turns with the leader, so that no two simulators have
   parallel regions open. After each frame of the leader, each follower goes on to its own first frame at or
   after the leader's time; then all states are shown together. The leader waits for the followers. When the
   leader travels in time, the followers travel too, as far as their kept past reaches. If any of these
   simulators is on a GPU, all step on the window's thread. */
#ifndef APP_RUN_SIMULATOR_H
#define APP_RUN_SIMULATOR_H

#include "app/run/measure/measure.h"
#include "app/run/recording/recording.h"
#include "app/scene/scene.h"
#include "render/particles/particles.h"
#include "sim/error.h"
#include "sim/gpu/gl.h"
#include "sim/world.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Simulator Simulator;

typedef struct SimulatorSetup {
    const Scene *scene; /* copied */
    const Recording
        *recording;          /* of this scene, without commands: the begin of the recorded session; copied */
    const Recording *script; /* a recorded session to play: its commands are obeyed at their steps until the
                                user acts; its pointers must outlive the simulator; NULL: none */
    Upload *upload;     /* for the scene's particles; outlives the simulator; NULL: the backend is on a GPU */
    GlTimer *timer;     /* for the stages on a GPU, which SimulatorStatus then lacks; may be NULL */
    void (*wake)(void); /* called on the solver's thread after each new state; may be NULL */
    bool paused;
    size_t history_bytes; /* memory for states to go back to (app/run/simulator_private.h); 0: no past */
    double until;         /* of a follower: last time, s; 0: the leader's */
    bool follows; /* follows a leader: starts with the leader, and obeys only commands sent to the follower */
    int follower_count;
    Simulator *const *followers; /* at most SIMULATOR_FOLLOWERS; must outlive the leader */
} SimulatorSetup;

enum { SIMULATOR_FOLLOWERS = 3 };

/* Starts the thread, which makes the world. Returns NULL if memory is short or no thread starts. */
Simulator *simulator_create(const SimulatorSetup *setup, Error *error);

/* Asks the thread to end and waits at most `patience_ms`: a frame of a large scene may take longer. Returns
   false if the thread still runs; then all of its data must stay, and only the end of the program ends the
   thread. */
bool simulator_destroy(Simulator *simulator, double patience_ms);

/* On a GPU: works for about `budget_ms` or one step. Returns the ms until the next due work unless the user
   acts; 0: more is due. Not on a GPU: does nothing and returns INFINITY. */
double simulator_work(Simulator *simulator, double budget_ms);
bool simulator_on_gpu(const Simulator *simulator);

/* Between hold and release no states are shown: states of a simulator and its followers taken then are of one
   time. Keep it short, as the simulator waits. Only for a simulator with followers. */
void simulator_hold(Simulator *simulator);
void simulator_release(Simulator *simulator);

/* On a GPU: fresh: a state exists that simulator_share has not shown yet; share: the present particles, as
   from world_share. Returns false without a world. */
bool simulator_fresh(const Simulator *simulator);
bool simulator_share(Simulator *simulator, unsigned attributes, ParticleBuffers *out);

/* Obeys a command that sets the backend, between two steps; the simulation continues on the new backend, with
   `upload` if not on a GPU. A failing move is reported in the status and changes nothing. `backend` gets the
   present backend. Returns false if the simulation does not answer and continues as before, or if nothing can
   continue. */
bool simulator_move(Simulator *simulator, const SimCommand *command, Upload *upload, char backend[NAME_SIZE],
                    Error *error);

/* Reloads the solver's shaders. Returns false if the shaders are wrong: the last good shaders stay. */
bool simulator_reload(Simulator *simulator, Error *error);

void simulator_pause(Simulator *simulator, bool paused);

/* Runs one more frame, then pauses; each call counts, also during a reset or a frame. `held`: a key repeat,
   which counts only when no such frame waits. */
void simulator_single_step(Simulator *simulator, bool held);

/* Travels to another time within SimulatorStatus.past: the last place at or before `time`; INFINITY is the
   newest. The latest request wins. From that place time runs on as before, with the recorded commands and the
   same bits. The first new command cuts off the later part, with a message. Waiting commands apply before the
   jump; waiting poses are dropped. */
void simulator_go_to(Simulator *simulator, double time);

/* Travels by `seconds` from the present time, or from the requested time. */
void simulator_go_by(Simulator *simulator, double seconds);

/* Travels one frame back, then pauses; `held` as of simulator_single_step. */
void simulator_step_back(Simulator *simulator, bool held);
void simulator_set_speed(Simulator *simulator,
                         double speed); /* simulated seconds per second, in real time mode */
void simulator_set_realtime(Simulator *simulator, bool realtime);

/* Restarts the scene: a new world and a new recording. Settings made since the start stay; waiting poses are
   dropped. */
void simulator_reset(Simulator *simulator);

/* Queues a command for the next step, which sets the command's `step`. Replaces waiting commands made moot by
   the new command. Returns the command's number, counted from 1, or 0 if too many wait,
   which takes more keys than exist. */
uint64_t simulator_send(Simulator *simulator, const SimCommand *command);

/* Resizes the box towards `size`, m, from the next step on, each side as fast as its wall may. A growing
   side jumps, a shrinking side moves at a small part of the speed of sound. Ends when the size is reached,
   another size is wanted, time jumps, or the solver refuses with a message. Each change is a command of
   the session. */
void simulator_resize(Simulator *simulator, const double size[3]);

/* The count of commands of simulator_send obeyed by the state of `step`; known for the last few hundred
   states. */
uint64_t simulator_applied(Simulator *simulator, uint64_t step);

/* Writes the session since the last start of the scene to `path`, from the solver's thread: after the present
   frame, and before any later request, also before the end. SimulatorStatus.saves counts completed saves.
   Returns false while an earlier save is pending. */
bool simulator_save(Simulator *simulator, const char *path);

/* Saves immediately, from any thread, regardless of the solver's thread: the recording so far, without its
   end (recording_write_cut). Returns false with the reason, also if a stuck thread holds the lock. */
bool simulator_save_cut(Simulator *simulator, const char *path, Error *error);

/* For a separate thread at the end of the program: a complete save if the solver's thread makes it within
   patience_ms, otherwise a cut save. `words` gets the result. */
bool simulator_save_last(Simulator *simulator, const char *path, double patience_ms, char words[1200]);

/* SimulatorStatus.unsaved. */
bool simulator_unsaved(Simulator *simulator);

/* Sets if the gauges and the probes are watched: watched values are taken at most every 50 ms, unwatched
   never. On a GPU probes wait for all particles. */
void simulator_watch(Simulator *simulator, bool gauges, bool probes);

enum { SIMULATOR_RING = 120, SIMULATOR_HISTORY = SIMULATOR_RING, SIMULATOR_GAUGES = SIMULATOR_RING };

/* A state's gauge, and the step before the state. */
typedef struct GaugeSample {
    WorldGauge gauge;
    double courant;  /* WorldInfo.courant */
    StepLimit limit; /* limit of the size of that step */
} GaugeSample;

/* Probe readings of a state, for each probe as many as probe_shown says, in sequence; NaN: dry. */
typedef struct ProbeSample {
    double time; /* s */
    float value[PROBES_SHOWN];
} ProbeSample;

/* The simulation's position in its past. */
typedef struct SimulatorHistory {
    bool enabled;     /* a past is kept: SimulatorSetup.history_bytes */
    bool rewound;     /* the present state is older than the newest */
    double from, to;  /* s: range of simulator_go_to */
    unsigned travels; /* count of jumps and of recorded commands obeyed again: each resets settings and hand
                         to their old values (simulator_settings) */
    BoxTarget target; /* target of the hand after a jump */
    size_t bytes;     /* of the states */
    size_t states;    /* count of states */
    bool travelling;  /* simulator_go_to or the like is pending */
    double last_jump_ms; /* wall time of the last jump */
} SimulatorHistory;

/* Progress of playing a recorded session. */
typedef enum ScriptState {
    SCRIPT_NONE,
    SCRIPT_PLAYS,
    SCRIPT_SAME,  /* reached the end, with the recorded bits */
    SCRIPT_OTHER, /* reached the end, with different bits */
    SCRIPT_CUT,   /* reached the end of a recording that was cut off */
    SCRIPT_LEFT   /* the user acted: the session continues by hand */
} ScriptState;

typedef struct SimulatorStatus {
    bool ready;  /* the world exists */
    bool failed; /* stopped, or no world: `message` says why; a reset restarts */
    bool ended;  /* the thread has ended; no more work is done */
    bool paused, realtime;
    bool rests;         /* all requested work is done, and no frame is due until the user acts */
    char message[1024]; /* of a failure or of a refused command; "": none */
    unsigned messages;  /* counts messages */
    unsigned solids;    /* count of changes of solids and box, see simulator_settings */
    double speed;
    double time;                        /* s, of the last state */
    double simulated_s;                 /* sum over all resets */
    double dt;                          /* of the last step, s */
    StepSolve solves[SOLVES_MAX];       /* figures of the iterative solvers in the last step */
    SolveFigures solved;                /* sum since the scene's start */
    StepLimit limit;                    /* limit of the size of the last step */
    uint64_t limited[STEP_LIMIT_COUNT]; /* count of steps per limit since the scene's start */
    uint64_t closed_gates;              /* closed gates: world_close_gates */
    uint64_t step, frames;              /* since the scene's start */
    size_t particles;                   /* of the last state */
    size_t lost;                        /* particles without a cell in the grid, in the last known step */
    double real_time_factor;            /* simulated over wall time in the last second; 0 while paused */
    double solved_ms;                   /* wall time of `frames` */
    double behind_s;                    /* wall time skipped because the solver was too slow, in all, s */
    bool resizing;                      /* simulator_resize is in progress */
    double box_wanted[3];               /* target size of the box */
    BoxTarget hand;                     /* the hand's part of the box's pose, after the filter */
    StageTimes stages;                  /* of the last frame */
    GlCalls calls;                      /* of the driver in the last substep, on a GPU; else 0 */
    int history_count;                  /* of `history`: wall time of the last frames, ms, oldest first */
    float history[SIMULATOR_HISTORY];
    int gauge_count; /* of `gauges`: the last ones since the scene's start, oldest first */
    GaugeSample gauges[SIMULATOR_GAUGES];
    int probe_count; /* as gauge_count, for `probes` */
    ProbeSample probes[SIMULATOR_GAUGES];
    SimulatorHistory timeline;
    ScriptState script;
    uint64_t script_steps;   /* length of the script */
    bool unsaved;            /* changed since the start, or since the last successful simulator_save */
    bool saving;             /* a simulator_save is pending */
    unsigned saves;          /* count of completed simulator_save */
    bool saved;              /* the last save succeeded */
    char save_message[1024]; /* error of the last save, or the saved file */
} SimulatorStatus;

void simulator_status(Simulator *simulator, SimulatorStatus *status);

/* Message to the user when a recorded session enters the state (NULL: none), and the state's name in JSON. */
const char *script_words(ScriptState state);
const char *script_name(ScriptState state);

/* The world's settings, box and solids after the last jump or change. */
void simulator_settings(Simulator *simulator, WorldDef *def);

#endif
