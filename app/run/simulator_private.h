/* Private parts of a running simulation: its history, and the state of a simulator for the source files. */
#ifndef APP_RUN_SIMULATOR_PRIVATE_H
#define APP_RUN_SIMULATOR_PRIVATE_H

#include "app/run/measure/measure.h"
#include "app/run/recording/recording.h"
#include "app/run/run.h"
#include "app/run/session.h"
#include "app/run/simulator.h"
#include "app/scene/scene.h"
#include "sim/error.h"
#include "sim/world.h"

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The past of a running simulation: earlier states within a memory limit, for going back in time.

   A place is the begin of a frame and has a number: 0 at the start of the scene, then one more per frame.
   Step and time are known of each place. Some places also have the full state (world_save: all inputs of the
   next step), the scene's settings and the count of obeyed commands. To reach a place between two states,
   load the state before and simulate on with the recorded commands, which gives the same bits. So a jump
   takes at most the time of the frames between two states. A state is kept every HISTORY_GAP_MS of frame
   time, or less often if copies would take more than a fiftieth of the time.

   When memory is full, every other state goes where jumps stay short, oldest first. Otherwise the oldest
   state goes, with all places before the next state. If less than HISTORY_WANTED_S of past remains, jumps may
   get longer before the oldest state goes. Not thread-safe. */

/* Frame time between two states, ms: while memory lasts; then the maximum; then the maximum if the past is
   shorter than HISTORY_WANTED_S seconds. The target for a jump is 200 ms, with loading and drawing included.
 */
#define HISTORY_GAP_MS       50.0
#define HISTORY_GAP_MOST_MS  150.0
#define HISTORY_GAP_SHORT_MS 1000.0
#define HISTORY_WANTED_S     10.0

typedef struct History History;

typedef struct HistoryPlace {
    uint64_t step;
    double time; /* s */
} HistoryPlace;

/* Creates a past of at most bytes_most. Returns NULL if memory is short. */
History *history_create(size_t bytes_most);
void history_destroy(History *history); /* NULL is allowed */

/* Forgets all places; the world's present state becomes place 0 (history_add_place). */
void history_begin(History *history, const WorldInfo *info);

/* Adds the next place after a frame of frame_ms. */
void history_add_place(History *history, const WorldInfo *info, double frame_ms);

/* Keeps the world's present state at the last place if a state is due, or if `now`. `scene`: with the changes
   by commands, of which `next` were obeyed. The state is not kept if memory is short or the state is unsound.
   Waits for a GPU's step, as the begin of the next frame would. The particles of a GPU come with later calls,
   a part at each: call at the begin of each frame. */
void history_keep(History *history, World *world, const Scene *scene, size_t next, bool now);

/* The oldest reachable place, and the last place; both are the last if no state is kept. */
uint64_t history_first(const History *history);
uint64_t history_last(const History *history);

/* Step and time of a place between first and last. */
HistoryPlace history_place(const History *history, uint64_t place);

/* The last reachable place at or before `time`. After a failure the last place has the time to which the
   simulation returned: the result is then the place before. */
uint64_t history_find(const History *history, double time);

/* The place whose state is loaded for `place`: the place itself, or the last kept state before. */
uint64_t history_state_before(const History *history, uint64_t place);

/* Loads the state of history_state_before(place) into the world; sets `scene` and *next accordingly. Returns
   false with the reason, with no changes. */
bool history_load(History *history, uint64_t place, World **world, Scene *scene, size_t *next, Error *error);

/* Forgets the places after `place`, which becomes the last. */
void history_cut(History *history, uint64_t place);

typedef struct HistoryFigures {
    size_t bytes, bytes_most, state_bytes; /* held; allowed; of the last state */
    size_t states;
    bool dropped; /* states were dropped for lack of memory, with less than HISTORY_WANTED_S left */
} HistoryFigures;
HistoryFigures history_figures(const History *history);

/* Private state of a simulator, for its source files. simulator.c takes requests, simulator_thread.c picks
   the due work and its thread, simulator_step.c does the work, simulator_history.c travels in time. */

enum {
    APPLIED_MAX = 512,
    COMMAND_QUEUE_MAX = 256 /* more than the count of live keys */
};

/* Commands waiting for the next step. All waiting commands apply at the same step, so a new command makes
   earlier ones moot. The queue never holds more than one pose of each kind and one value of each key. */
typedef struct CommandQueue {
    int count;
    SimCommand commands[COMMAND_QUEUE_MAX];
} CommandQueue;

/* The present frame, possibly with steps left. */
typedef struct FrameInProgress {
    bool begun;
    StageClock clock;
    double spent_ms, from_s; /* wall time of its steps; simulated time at its begin */
    GlCalls calls;           /* of the last substep, on a GPU */
} FrameInProgress;

/* The count of commands obeyed by the state of a step. */
typedef struct AppliedCommands {
    uint64_t step, commands;
} AppliedCommands;

/* A requested travel in time. */
typedef struct TravelRequest {
    bool pending, by_frames;
    bool after;  /* the first place at or after `time`; otherwise the last at or before */
    double time; /* s */
    int frames;  /* to go back */
} TravelRequest;

/* The newest state, while the present state is older. */
typedef struct NewestState {
    uint64_t step, hash;
    double time;
} NewestState;

/* The next work of the solver's thread. */
typedef struct SimulatorWork {
    bool reset, save, frame, travel;
    TravelRequest request;
    char save_path[1024];
    CommandQueue commands;
} SimulatorWork;

struct Simulator {
    pthread_t thread;
    pthread_mutex_t lock; /* guards all fields down to `obeyed` */
    pthread_cond_t changed;
    bool rests;             /* no work was found at the last look */
    bool quit, ended, idle; /* idle: no frame was due while paused or failed */
    bool paused, realtime, reset;
    int singles; /* frames that are due although paused */
    double speed;
    bool save, saving; /* requested; requested and pending */
    bool save_later;   /* a reset was requested before the save */
    char save_path[1024];
    CommandQueue queue;
    uint64_t sent; /* count of commands */
    TravelRequest request;
    WorldDef settings; /* after the last jump */
    double last_due;   /* wall time at which the last frame was due, ms */
    double frame_time; /* simulated time of the last frame, s */
    SimulatorStatus status;
    int history_next, gauge_next, probe_next; /* of the rings in `status` */
    int applied_next;
    bool watched, watched_probes; /* gauges; probes */
    AppliedCommands applied[APPLIED_MAX];

    /* for the stepping thread only */
    bool here;    /* steps on the caller's thread: a backend is on a GPU, */
    bool on_gpu;  /* the simulator's own backend */
    double until; /* of a follower: see SimulatorSetup */
    bool follows; /* steps on the leader's thread */
    int follower_count;
    Simulator *followers[SIMULATOR_FOLLOWERS];
    pthread_mutex_t showing; /* states of the leader and of the followers are being shown or taken */
    GlTimer *timer;          /* for stages on a GPU; may be NULL */
    Scene start;             /* as given */
    Run run;
    SimulatorWork *work;
    FrameInProgress frame;
    uint64_t published, shown; /* counts of states; used with `here` */
    GaugeSample gauge;         /* requested; its gauge is pending */
    double gauge_ms;           /* wall time of the request */
    double probes_ms;          /* wall time of the last reading of the probes */
    Recording recording;
    Recording script;    /* a session to play; its commands belong to the caller */
    size_t script_next;  /* index of the script's next command */
    bool scripted;       /* the script has not ended, and the user has not acted */
    bool recording_lost; /* memory was short for a command */
    History *history;    /* NULL: no states are kept */
    uint64_t at;         /* place of the present frame's begin */
    bool rewound;        /* later places exist: time follows the recording, */
    size_t next;         /* index of its next command */
    NewestState newest;  /* used if `behind` */
    double resized_time; /* s, of the last change of simulator_continue_resizing; -INFINITY: none yet */
    bool reported_short, reported_other, reported_long, reported_none, reported_kept;
    Upload *upload;
    void (*wake)(void);
    uint64_t taken; /* count of commands */
    double pace_began_ms, pace_began_s;
};

/* simulator.c. Adds a copy, which replaces moot commands. A target replaces the waiting target, a pose
   jump all poses, a finger the same finger motion, a finger's end all finger commands, a setting the setting
   of the same key. Returns false if the queue is full. */
bool command_queue_add(CommandQueue *queue, const SimCommand *command);

/* Drops all commands except settings (poses, fingers, gates, solids, sizes): the scene restarts with the box
   at home, or time jumps. */
void command_queue_drop_hand(CommandQueue *queue);

/* simulator_step.c: for the stepping thread. */
bool simulator_publish(Simulator *simulator, Error *error); /* describes the state, then shows it */
void simulator_make_world(Simulator *simulator); /* at the scene's start; shows the world if there is no
                                                    leader or follower; reports errors */
void simulator_report(Simulator *simulator, bool failed, const char *message);
void simulator_apply(Simulator *simulator, const SimCommand *command);
void simulator_restart(Simulator *simulator, SimulatorWork *work);
void simulator_save_session(Simulator *simulator, const char *path);
void simulator_frame_begin(Simulator *simulator);
void simulator_frame_step(Simulator *simulator); /* may end the frame */
void simulator_frame_end(Simulator *simulator);

/* simulator_thread.c: steps for the followers after a frame, before its state is shown. */
void simulator_lead(Simulator *simulator);

/* Shows the simulator's state and its followers' states. */
bool simulator_show(Simulator *simulator, Error *error);

/* simulator_history.c: for the stepping thread. Begin: for a new world or a new backend; keep: at the begin
   of a frame; mark: at its end. */
void simulator_history_begin(Simulator *simulator);
void simulator_history_keep(Simulator *simulator);
void simulator_history_mark(Simulator *simulator, double frame_ms);
void simulator_history_status(Simulator *simulator); /* with the lock held */

/* Travels to work->request, between two frames. */
void simulator_travel(Simulator *simulator, SimulatorWork *work);

/* Behind the newest state: obeys the recorded commands due at the present step. */
void simulator_apply_recorded(Simulator *simulator);

/* Cuts if one of the commands changes the simulation. */
void simulator_cut_for(Simulator *simulator, const SimCommand commands[], int count);

/* Lifts a finger in the fluid: its end lies in a cut future, or in none yet. */
void simulator_lift_finger(Simulator *simulator);

/* Tells views that settings and hand have the values of recorded commands. */
void simulator_report_travel(Simulator *simulator);

/* simulator_step.c: the user acts and takes over from a played session. */
void simulator_script_leave(Simulator *simulator);

/* Time jumps or restarts. */
void simulator_stop_resizing(Simulator *simulator);

/* simulator_gauges.c: after a frame; for a new world. */
void simulator_gauge(Simulator *simulator);
void simulator_gauge_begin(Simulator *simulator);
void simulator_gauge_back(Simulator *simulator, double time); /* drops gauges of later times */

/* After a frame; for a new world, with the scene's probes. */
void simulator_probes(Simulator *simulator);
void simulator_probes_begin(Simulator *simulator);
void simulator_probes_back(Simulator *simulator, double time); /* drops readings of later times */

/* The rings of SimulatorStatus; with the lock held. simulator_ring_add: counts the entry written at `next`.
   simulator_rings: copies all rings, oldest entries first. */
void simulator_ring_add(int *next, int *count);
void simulator_rings(const Simulator *simulator, SimulatorStatus *status);

#endif
