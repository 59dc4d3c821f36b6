/* The solver at its own pace, beside the view: a thread that owns the World, obeys commands between two
   steps, and hands the state after each step to the upload ring: a picture shows what is newest, not the last
   whole frame, which answers the hand sooner by some half a frame.

   It paces itself by the wall clock where the scene says `realtime` (as many frames as the clock asks for,
   times the speed; what it cannot keep up with is left out, dt stays), else runs as fast as it can. It never
   waits for the view. On a software driver views open parallel regions on the window's thread too (planes,
   trails, layers of points): then two are open side by side, each with threads of its own. All functions here
   belong to one other thread, that of the window.

   A backend on a GPU steps on that other thread instead, where the context is: simulator_work does what is
   due, and the views read the world's own buffers.

   Simulators that follow another one step on its thread, in turns with it, so that no two of them have
   parallel regions open: after each of its frames each of them goes on to its own first frame at or after
   that time, and then all states are shown together; the leader waits for them. Where it goes in time they
   go, as far as they kept theirs. Where one of them is on a GPU all step on the window's thread. */
#ifndef SLOSH_SIMULATOR_H
#define SLOSH_SIMULATOR_H

#include "app/probe/probe.h"
#include "app/recording/recording.h"
#include "app/recording/sim_command.h"
#include "app/scene/scene.h"
#include "render/particles/upload.h"
#include "sim/base/error.h"
#include "sim/base/stage.h"
#include "sim/gl/timer.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Simulator Simulator;

typedef struct SimulatorSetup {
    const Scene *scene; /* copied */
    const Recording
        *recording; /* of this scene, its commands left out: where the recorded session begins; copied */
    const Recording *script; /* whose commands are obeyed at their steps until somebody acts: a recorded
                                session, played; what it points at outlives the simulator; NULL: none */
    Upload *upload;     /* for the scene's particles; outlives the simulator; NULL: the backend is on a GPU */
    GlTimer *timer;     /* for the stages there, which are not in SimulatorStatus then; may be NULL */
    void (*wake)(void); /* called on the solver's thread after each new state; may be NULL */
    bool paused;
    size_t past_bytes; /* memory for states to step back to (app/session/past.h); 0: nothing is kept */
    bool follows;      /* another one: it begins with that one, and obeys its commands alone */
    int follower_count;
    Simulator *const *followers; /* which outlive it; at most SIMULATOR_FOLLOWERS */
} SimulatorSetup;

enum { SIMULATOR_FOLLOWERS = 3 };

/* Starts the thread, which makes the world. NULL when there is no memory or no thread. */
Simulator *simulator_create(const SimulatorSetup *setup, Error *error);

/* Asks the thread to end and waits for it, at most `patience_ms`: a frame of a large scene may take longer.
   False when it still runs; then all that it uses must stay, and only the end of the program ends it. */
bool simulator_destroy(Simulator *simulator, double patience_ms);

/* On a GPU: does what is due, for about `budget_ms` or one step, and returns for how many ms nothing will be
   due unless it is asked for: 0, there is more. Else there is nothing to do here: INFINITY. */
double simulator_work(Simulator *simulator, double budget_ms);
bool simulator_on_gpu(const Simulator *simulator);

/* Between the two no states are shown: what is taken there, of a simulator and its followers, is of one time.
   Not for long: it waits meanwhile. Only for one with followers. */
void simulator_hold(Simulator *simulator);
void simulator_release(Simulator *simulator);

/* On a GPU: whether there is a state that simulator_share has not shown; the particles as they are now,
   world_share. False when there is no world. */
bool simulator_fresh(const Simulator *simulator);
bool simulator_share(Simulator *simulator, unsigned attributes, ParticleBuffers *out);

/* Obeys a command that sets the backend, between two steps; the simulation goes on there, with `upload` where
   it is not on a GPU. A move that fails is told in the status, and all stays as it was: `backend` gets the
   present one. False when the simulation does not answer, and goes on as it did, or nothing can go on. */
bool simulator_move(Simulator *simulator, const SimCommand *command, Upload *upload, char backend[NAME_SIZE],
                    Error *error);

/* The solver's shaders have changed; false where they are wrong: the last good ones stay. */
bool simulator_reload(Simulator *simulator, Error *error);

void simulator_pause(Simulator *simulator, bool paused);

/* One frame more, then paused; each call counts, also while a reset or a frame lasts. `held`: the key comes
   again by itself, and counts only when no such frame waits. */
void simulator_single_step(Simulator *simulator, bool held);

/* To another time, of those that are kept (SimulatorStatus.past): the place at that time or the last one
   before it, as far as it goes; INFINITY is the newest one. The newest wish counts. From there time runs on
   as it did, with the commands that were given then, and the same bits; the first new command cuts off what
   came after, and says so. Commands that wait apply before the jump, poses are forgotten. */
void simulator_go_to(Simulator *simulator, double time);

/* So many seconds on or back from where it is, or from where it is to go. */
void simulator_go_by(Simulator *simulator, double seconds);

/* One frame back, then paused; `held` as of simulator_single_step. */
void simulator_step_back(Simulator *simulator, bool held);
void simulator_set_speed(Simulator *simulator,
                         double speed); /* simulated seconds in a second, in real time */
void simulator_set_realtime(Simulator *simulator, bool realtime);

/* The scene from its start: a new world, and a new recording. What was set since stays set; poses that wait
   are forgotten. */
void simulator_reset(Simulator *simulator);

/* A command for the next step; its `step` is set there. It replaces what waits and is moot by it
   (simulator_queue.c). Returns its number, counted from 1, or 0 when too many wait, which takes
   more keys than there are. */
uint64_t simulator_send(Simulator *simulator, const SimCommand *command);

/* The box goes to that size, m, from the next step on, each side as fast as its wall may: a side that grows
   is there at once, one that shrinks comes in at a small part of the speed of sound. Until it is there,
   another size is wanted, time jumps or the solver says why not. Each change is a command of the session. */
void simulator_resize(Simulator *simulator, const double size[3]);

/* How many commands the state of that step had obeyed, of those counted by simulator_send; of the last few
   hundred states. */
uint64_t simulator_obeyed(Simulator *simulator, uint64_t step);

/* Writes the session since the last start of the scene to `path`, from the solver's thread, when the frame in
   hand is done and before anything that is asked for later, the end included; SimulatorStatus.saves counts
   what is done. False while an earlier one is not. */
bool simulator_save(Simulator *simulator, const char *path);

/* The same at once, from any thread and whatever the solver's does: as far as it is recorded, without its end
   (recording_write_cut). False with the reason, also where a thread that has stopped holds it. */
bool simulator_save_cut(Simulator *simulator, const char *path, Error *error);

/* From a thread beside, at the end of the program: whole where the solver's thread does it in that time, else
   cut. `words` say what came of it. */
bool simulator_save_last(Simulator *simulator, const char *path, double patience_ms, char words[1200]);

/* SimulatorStatus.unsaved. */
bool simulator_unsaved(Simulator *simulator);

/* Whether somebody looks at the gauges, and at what probes read: then one is taken every 50 ms at most, else
   none. On a GPU probes wait for all particles. */
void simulator_watch(Simulator *simulator, bool gauges, bool probes);

enum { SIMULATOR_HISTORY = 120, SIMULATOR_GAUGES = 120 };

/* A state's gauge, and the step before it. */
typedef struct GaugeSample {
    WorldGauge gauge;
    double courant;  /* WorldInfo.courant */
    StepLimit limit; /* what bounded that step */
} GaugeSample;

/* What a state's probes read, of each what probe_shown says, one behind the other; NaN: dry. */
typedef struct ProbeSample {
    double time; /* s */
    float value[PROBES_SHOWN];
} ProbeSample;

/* Where the simulation is in its past. */
typedef struct SimulatorPast {
    bool kept;           /* there is one: SimulatorSetup.past_bytes */
    bool behind;         /* the present state is not the newest one */
    double from, to;     /* s: what simulator_go_to reaches */
    unsigned travels;    /* counts jumps, and recorded commands that were obeyed again: settings and hand are
                            then what they were (simulator_settings) */
    BoxTarget target;    /* of the hand, where it travelled to */
    size_t bytes;        /* of the states, */
    size_t states;       /* and how many */
    bool travelling;     /* simulator_go_to and the like are not done yet */
    double last_jump_ms; /* wall time of the last of them */
} SimulatorPast;

/* How far a recorded session has come that is played. */
typedef enum ScriptState {
    SCRIPT_NONE,
    SCRIPT_PLAYS,
    SCRIPT_SAME,  /* its end has come, with the recorded bits, */
    SCRIPT_OTHER, /* with other ones, */
    SCRIPT_CUT,   /* or the end of what was recorded before that was cut off */
    SCRIPT_LEFT   /* somebody acted: it goes on by hand */
} ScriptState;

typedef struct SimulatorStatus {
    bool ready;  /* the world is there */
    bool failed; /* it stopped, or could not be made: `message` says why; a reset starts it anew */
    bool ended;  /* the thread; nothing will be done any more */
    bool paused, realtime;
    bool rests;         /* all that was asked for is done, and no frame is due until somebody acts */
    char message[1024]; /* of the failure, or of a command that could not be obeyed; "" */
    unsigned messages;  /* counts messages */
    unsigned solids;    /* counts changes of solids and box, which simulator_settings has */
    double speed;
    double time;                        /* s, of the last state */
    double simulated_s;                 /* all resets together */
    double dt;                          /* of the last step, s */
    StepSolve solves[SOLVES_MAX];       /* what solvers that iterate did in it, */
    SolveFigures solved;                /* and since the scene's start */
    StepLimit limit;                    /* what bounded it, */
    uint64_t limited[STEP_LIMIT_COUNT]; /* and all steps since the scene's start */
    uint64_t shut;                      /* gates: world_shut */
    uint64_t step, frames;              /* since the scene's start */
    size_t particles;                   /* of the last state */
    size_t lost;                        /* particles without a place in the grid, in the last step known */
    double real_time_factor;            /* simulated over wall time in the last second; 0 while paused */
    double solved_ms;                   /* wall time of these frames */
    double behind_s;                    /* wall time that the solver could not keep up with, in all, s */
    bool resizing;                      /* simulator_resize is not done, */
    double box_wanted[3];               /* and to what size it goes */
    BoxTarget hand;                     /* the hand's part of the box's pose, as the filter has it */
    StageTimes stages;                  /* of the last frame */
    int history_count;                  /* of `history`: wall time of the last frames, ms, oldest first */
    float history[SIMULATOR_HISTORY];
    int gauge_count; /* of `gauges`: the last ones since the scene's start, oldest first */
    GaugeSample gauges[SIMULATOR_GAUGES];
    int probe_count; /* the same of `probes` */
    ProbeSample probes[SIMULATOR_GAUGES];
    SimulatorPast past;
    ScriptState script;
    uint64_t script_steps; /* to its end */
    bool unsaved;          /* something was done since the start, or since a simulator_save that succeeded */
    bool saving;           /* a simulator_save is not done yet */
    unsigned saves;        /* counts simulator_save that ended */
    bool saved;            /* whether the last one succeeded */
    char save_message[1024]; /* its error, or what it saved */
} SimulatorStatus;

void simulator_status(Simulator *simulator, SimulatorStatus *status);

/* What the user is told where a recorded session comes into that state: NULL, nothing; its name in JSON. */
const char *script_words(ScriptState state);
const char *script_name(ScriptState state);

/* The world's settings as they were where the simulation last travelled to. */
void simulator_settings(Simulator *simulator, WorldDef *def);

#endif
