/* Inside a simulator: for the files that make one up. simulator.c takes what is asked for, simulator_work.c
   decides what is due and on which thread it is done, simulator_session.c does it, simulator_past.c goes back
   and forth in time. */
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
    COMMAND_QUEUE_MAX = 256 /* more than there are live keys */
};

/* Commands that wait for the simulation's next step. All that wait apply at the same step, so a command makes
   earlier ones moot, and the queue never holds more than one pose of each kind and one value of each key. */
typedef struct CommandQueue {
    int count;
    SimCommand commands[COMMAND_QUEUE_MAX];
} CommandQueue;

/* A frame of which steps may be left. */
typedef struct FrameInHand {
    bool begun;
    StageClock clock;
    double spent_ms, from_s; /* wall time of its steps; simulated time at its begin */
} FrameInHand;

/* How many commands the state of a step had obeyed. */
typedef struct Obeyed {
    uint64_t step, commands;
} Obeyed;

/* A time to go to. */
typedef struct Wish {
    bool pending, by_frames;
    bool after;  /* the place at that time or the first one after it; else before it */
    double time; /* s */
    int frames;  /* back from where it is */
} Wish;

/* The newest state, while the simulation is behind it. */
typedef struct Newest {
    uint64_t step, hash;
    double time;
} Newest;

/* What the solver's thread is to do next. */
typedef struct Work {
    bool reset, save, frame, travel;
    Wish wish;
    char save_path[1024];
    CommandQueue commands;
} Work;

struct Simulator {
    pthread_t thread;
    pthread_mutex_t lock; /* of all down to `obeyed` */
    pthread_cond_t changed;
    bool rests;             /* no work was found, at the last look for it */
    bool quit, ended, idle; /* idle: no frame was due for as long as something forbade it */
    bool paused, realtime, reset;
    int singles; /* frames that are due although paused */
    double speed;
    bool save, saving; /* asked for; asked for and not done */
    bool save_later;   /* a reset was asked for before it */
    char save_path[1024];
    CommandQueue queue;
    uint64_t sent; /* commands */
    Wish wish;
    WorldDef settings; /* where it travelled to */
    double last_due;   /* wall time at which the last frame was to begin, ms */
    double frame_time; /* simulated by the last frame, s */
    SimulatorStatus status;
    int history_next, gauge_next, probe_next, obeyed_next;
    bool watched, watched_probes; /* the gauges are, the probes */
    Obeyed obeyed[OBEYED_MAX];

    /* of the thread that steps alone */
    bool here;    /* that is the caller's: a backend is on a GPU, */
    bool on_gpu;  /* its own */
    bool follows; /* it is another one's thread */
    int follower_count;
    Simulator *followers[SIMULATOR_FOLLOWERS];
    pthread_mutex_t showing; /* states of it and of its followers are being shown, or taken */
    GlTimer *timer;          /* for the stages there; may be NULL */
    Scene start, scene;      /* as given; as the commands have changed it */
    World *world;
    Work *work;
    FrameInHand frame;
    uint64_t published, shown; /* states; with `here` */
    GaugeSample gauge;         /* on its way; its gauge is not there yet */
    double gauge_ms;           /* wall time at which it was asked for */
    Probes *probes;            /* of the scene; NULL: it has none */
    Cloud cloud;               /* for them, */
    float *read;               /* and a number a column */
    double probes_ms;          /* wall time at which they were read */
    bool feels;                /* one of them is a force, which the world sums */
    Recording recording;
    TroubleTold told_trouble;
    bool told_full;       /* that its emitters wait */
    uint64_t told_barred; /* gates of emitters, that they find no room */
    bool told_lost;       /* that particles find no place in the grid */
    bool told_unlisted;
    FluidWatch watch;
    Recording script;    /* a session that is done again; its commands are the caller's */
    size_t script_next;  /* its command that applies next */
    bool scripted;       /* it has not come to its end, and nobody has acted */
    bool recording_lost; /* no memory for all of its commands */
    Past *past;          /* NULL: none is kept */
    uint64_t at;         /* place in it of the present frame's begin */
    bool behind;         /* there are later places: time follows the recording, */
    size_t next;         /* whose command this is the next one then */
    Newest newest;       /* then */
    double resized_time; /* s, of the last change of simulator_go_on_resizing; -INFINITY: none yet */
    bool told_short, told_other, told_long, told_none, told_kept;
    Upload *upload;
    void (*wake)(void);
    uint64_t taken; /* commands */
    double pace_began_ms, pace_began_s;
};

/* simulator_queue.c. Adds a copy: a target in the place of one that waits, a pose jump in the place of all
   poses, a finger in the place of one that does the same, its end in the place of all of it, a setting in the
   place of one of the same key. False when it is full. */
bool command_queue_add(CommandQueue *queue, const SimCommand *command);

/* Forgets targets, pose jumps and fingers: the scene begins anew, with the box at home. */
void command_queue_drop_hand(CommandQueue *queue);

/* simulator_session.c: of the thread that steps. */
bool simulator_publish(Simulator *simulator, Error *error); /* describes the state, then shows it */
void simulator_make_world(Simulator *simulator); /* at the scene's start, or a message; shows it, where none
                                                    follows it and it follows none */
void simulator_tell(Simulator *simulator, bool failed, const char *message);
void simulator_obey(Simulator *simulator, const SimCommand *command);
void simulator_restart(Simulator *simulator, Work *work);
void simulator_save_session(Simulator *simulator, const char *path);
void simulator_frame_begin(Simulator *simulator);
void simulator_frame_step(Simulator *simulator); /* may end the frame */
void simulator_frame_end(Simulator *simulator);

/* simulator_work.c: the wish that waits, with the lock held. */
void simulator_take_wish(Simulator *simulator, Work *work);

/* simulator_lead.c: what the followers do where it begins, begins anew, or has gone to another time; after a
   frame, before its state is shown. */
void simulator_lead_begin(Simulator *simulator);
void simulator_lead_restart(Simulator *simulator);
void simulator_lead_travel(Simulator *simulator);
void simulator_lead(Simulator *simulator);

/* Shows the state, and those of the followers. */
bool simulator_show(Simulator *simulator, Error *error);

/* simulator_past.c: of the thread that steps. Where a new world begins, or goes on with another backend; at
   the begin of a frame, and at its end. */
void simulator_past_begin(Simulator *simulator);
void simulator_past_keep(Simulator *simulator);
void simulator_past_mark(Simulator *simulator, const WorldInfo *info, double frame_ms);
void simulator_past_status(Simulator *simulator, const WorldInfo *info); /* with the lock held */

/* Goes to work->wish, between two frames. */
void simulator_travel(Simulator *simulator, Work *work);

/* Behind the newest state: the recorded commands that apply at the present step. */
void simulator_obey_recorded(Simulator *simulator);

/* The user acts: what comes after the present state will not be. */
void simulator_cut(Simulator *simulator);

/* The same where one of the commands to be obeyed changes that. */
void simulator_cut_for(Simulator *simulator, const SimCommand commands[], int count);

/* A finger that is in the fluid leaves it: its end is of a future that will not be, or of none yet. */
void simulator_lift_finger(Simulator *simulator);

/* Settings and hand are what a recorded command made of them. */
void simulator_tell_travel(Simulator *simulator);

/* simulator_script.c: where a new world begins; between two substeps, before what the user asked for; when
   the user acts. */
void simulator_script_begin(Simulator *simulator);
void simulator_script_obey(Simulator *simulator);
void simulator_script_leave(Simulator *simulator);

/* simulator_size.c: between two substeps, after all that was asked for; where time jumps or begins anew. */
void simulator_go_on_resizing(Simulator *simulator);
void simulator_stop_resizing(Simulator *simulator);

/* simulator_gauge.c: after a frame, and where a new world begins. */
void simulator_gauge(Simulator *simulator);
void simulator_gauge_begin(Simulator *simulator);
void simulator_gauge_back(Simulator *simulator, double time); /* forgets what is of a later time */
void simulator_gauge_status(const Simulator *simulator, SimulatorStatus *status); /* with the lock held */

/* simulator_probes.c: after a frame; where a new world begins, with the scene's probes; at the end. */
void simulator_probes(Simulator *simulator);
void simulator_probes_begin(Simulator *simulator);
void simulator_probes_end(Simulator *simulator);
void simulator_probes_back(Simulator *simulator, double time); /* forgets what is of a later time */
void simulator_probes_status(const Simulator *simulator, SimulatorStatus *status); /* with the lock held */

#endif
