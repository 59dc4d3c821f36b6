/* Private state of a simulator, for its source files. simulator.c takes requests, simulator_work.c picks the
   due work and its thread, simulator_session.c does the work, simulator_past.c travels in time. */
#ifndef SLOSH_SIMULATOR_STATE_H
#define SLOSH_SIMULATOR_STATE_H

#include "app/outcome/fluid_watch.h"
#include "app/recording/sim_command.h"
#include "app/session/past.h"
#include "app/session/session.h"
#include "app/session/simulator.h"
#include "sim/world/world.h"

#include <pthread.h>

enum {
    OBEYED_MAX = 512,
    COMMAND_QUEUE_MAX = 256 /* more than the count of live keys */
};

/* Commands waiting for the next step. All waiting commands apply at the same step, so a new command makes
   earlier ones moot. The queue never holds more than one pose of each kind and one value of each key. */
typedef struct CommandQueue {
    int count;
    SimCommand commands[COMMAND_QUEUE_MAX];
} CommandQueue;

/* The present frame, possibly with steps left. */
typedef struct FrameInHand {
    bool begun;
    StageClock clock;
    double spent_ms, from_s; /* wall time of its steps; simulated time at its begin */
} FrameInHand;

/* The count of commands obeyed by the state of a step. */
typedef struct Obeyed {
    uint64_t step, commands;
} Obeyed;

/* A requested travel in time. */
typedef struct Wish {
    bool pending, by_frames;
    bool after;  /* the first place at or after `time`; otherwise the last at or before */
    double time; /* s */
    int frames;  /* to go back */
} Wish;

/* The newest state, while the present state is older. */
typedef struct Newest {
    uint64_t step, hash;
    double time;
} Newest;

/* The next work of the solver's thread. */
typedef struct Work {
    bool reset, save, frame, travel;
    Wish wish;
    char save_path[1024];
    CommandQueue commands;
} Work;

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
    Wish wish;
    WorldDef settings; /* after the last jump */
    double last_due;   /* wall time at which the last frame was due, ms */
    double frame_time; /* simulated time of the last frame, s */
    SimulatorStatus status;
    int history_next, gauge_next, probe_next, obeyed_next;
    bool watched, watched_probes; /* gauges; probes */
    Obeyed obeyed[OBEYED_MAX];

    /* for the stepping thread only */
    bool here;    /* steps on the caller's thread: a backend is on a GPU, */
    bool on_gpu;  /* the simulator's own backend */
    bool follows; /* steps on the leader's thread */
    int follower_count;
    Simulator *followers[SIMULATOR_FOLLOWERS];
    pthread_mutex_t showing; /* states of the leader and of the followers are being shown or taken */
    GlTimer *timer;          /* for stages on a GPU; may be NULL */
    Scene start, scene;      /* as given; with the changes by commands */
    World *world;
    Work *work;
    FrameInHand frame;
    uint64_t published, shown; /* counts of states; used with `here` */
    GaugeSample gauge;         /* requested; its gauge is pending */
    double gauge_ms;           /* wall time of the request */
    Probes *probes;            /* of the scene; NULL: none */
    Cloud cloud;               /* for the probes */
    float *read;               /* one number per column of the probes */
    double probes_ms;          /* wall time of the last reading */
    bool feels;                /* a probe measures a force, which the world sums */
    Recording recording;
    TroubleTold told_trouble;
    bool told_full;       /* reported: emitters wait */
    uint64_t told_barred; /* bits of emitter gates already reported as blocked */
    bool told_lost;       /* reported: particles have no cell in the grid */
    bool told_unlisted;
    FluidWatch watch;
    Recording script;    /* a session to play; its commands belong to the caller */
    size_t script_next;  /* index of the script's next command */
    bool scripted;       /* the script has not ended, and the user has not acted */
    bool recording_lost; /* memory was short for a command */
    Past *past;          /* NULL: no past is kept */
    uint64_t at;         /* place of the present frame's begin */
    bool behind;         /* later places exist: time follows the recording, */
    size_t next;         /* index of its next command */
    Newest newest;       /* used if `behind` */
    double resized_time; /* s, of the last change of simulator_go_on_resizing; -INFINITY: none yet */
    bool told_short, told_other, told_long, told_none, told_kept;
    Upload *upload;
    void (*wake)(void);
    uint64_t taken; /* count of commands */
    double pace_began_ms, pace_began_s;
};

/* simulator_queue.c. Adds a copy, which replaces moot commands. A target replaces the waiting target, a pose
   jump all poses, a finger the same finger motion, a finger's end all finger commands, a setting the setting
   of the same key. Returns false if the queue is full. */
bool command_queue_add(CommandQueue *queue, const SimCommand *command);

/* Drops all commands except settings (poses, fingers, gates, solids, sizes): the scene restarts with the box
   at home, or time jumps. */
void command_queue_drop_hand(CommandQueue *queue);

/* simulator_session.c: for the stepping thread. */
bool simulator_publish(Simulator *simulator, Error *error); /* describes the state, then shows it */
void simulator_make_world(Simulator *simulator); /* at the scene's start; shows the world if there is no
                                                    leader or follower; reports errors */
void simulator_tell(Simulator *simulator, bool failed, const char *message);
void simulator_obey(Simulator *simulator, const SimCommand *command);
void simulator_restart(Simulator *simulator, Work *work);
void simulator_save_session(Simulator *simulator, const char *path);
void simulator_frame_begin(Simulator *simulator);
void simulator_frame_step(Simulator *simulator); /* may end the frame */
void simulator_frame_end(Simulator *simulator);

/* simulator_work.c: takes the waiting wish. Call with the lock held. */
void simulator_take_wish(Simulator *simulator, Work *work);

/* simulator_lead.c: steps for the followers when the leader begins, restarts or has travelled; after a frame,
   before its state is shown. */
void simulator_lead_begin(Simulator *simulator);
void simulator_lead_restart(Simulator *simulator);
void simulator_lead_travel(Simulator *simulator);
void simulator_lead(Simulator *simulator);

/* Shows the simulator's state and its followers' states. */
bool simulator_show(Simulator *simulator, Error *error);

/* simulator_past.c: for the stepping thread. Begin: for a new world or a new backend; keep: at the begin of a
   frame; mark: at its end. */
void simulator_past_begin(Simulator *simulator);
void simulator_past_keep(Simulator *simulator);
void simulator_past_mark(Simulator *simulator, const WorldInfo *info, double frame_ms);
void simulator_past_status(Simulator *simulator, const WorldInfo *info); /* with the lock held */

/* Travels to work->wish, between two frames. */
void simulator_travel(Simulator *simulator, Work *work);

/* Behind the newest state: obeys the recorded commands due at the present step. */
void simulator_obey_recorded(Simulator *simulator);

/* The user acts: cuts off the recording after the present state. */
void simulator_cut(Simulator *simulator);

/* Cuts if one of the commands changes the simulation. */
void simulator_cut_for(Simulator *simulator, const SimCommand commands[], int count);

/* Lifts a finger in the fluid: its end lies in a cut future, or in none yet. */
void simulator_lift_finger(Simulator *simulator);

/* Tells views that settings and hand have the values of recorded commands. */
void simulator_tell_travel(Simulator *simulator);

/* simulator_script.c: for a new world; between two substeps, before the user's commands; when the user
   acts. */
void simulator_script_begin(Simulator *simulator);
void simulator_script_obey(Simulator *simulator);
void simulator_script_leave(Simulator *simulator);

/* simulator_size.c: between two substeps, after all commands; when time jumps or restarts. */
void simulator_go_on_resizing(Simulator *simulator);
void simulator_stop_resizing(Simulator *simulator);

/* simulator_gauge.c: after a frame; for a new world. */
void simulator_gauge(Simulator *simulator);
void simulator_gauge_begin(Simulator *simulator);
void simulator_gauge_back(Simulator *simulator, double time); /* drops gauges of later times */
void simulator_gauge_status(const Simulator *simulator, SimulatorStatus *status); /* with the lock held */

/* simulator_probes.c: after a frame; for a new world, with the scene's probes; at the end. */
void simulator_probes(Simulator *simulator);
void simulator_probes_begin(Simulator *simulator);
void simulator_probes_end(Simulator *simulator);
void simulator_probes_back(Simulator *simulator, double time); /* drops readings of later times */
void simulator_probes_status(const Simulator *simulator, SimulatorStatus *status); /* with the lock held */

#endif
