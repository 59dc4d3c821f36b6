/* Messages of the window: a line in the picture for some seconds, and on standard error. */
#ifndef APP_WINDOW_MODEL_H
#define APP_WINDOW_MODEL_H

#include "app/window/window.h"

#include "app/files/pictures.h"
#include "app/input/input.h"
#include "app/run/compare/compare.h"
#include "app/run/playback/playback.h"
#include "app/run/recording/recording.h"
#include "app/run/simulator.h"
#include "app/scene/scene.h"
#include "render/particles/particles.h"
#include "sim/error.h"
#include "sim/gpu/gl.h"
#include "sim/gpu/particle_buffers.h"

#include <stdatomic.h>
#include <stdbool.h>

/* Zero-initialise before use. */
typedef struct Notice {
    bool quiet; /* only errors go to standard error */
    char words[320];
    double until_ms;   /* wall time */
    bool fresh, stood; /* for notice_changed */
} Notice;

void notice_tell(Notice *notice, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Reports an error, even with --quiet. */
void notice_error(Notice *notice, const char *message);

/* The line shown now, or NULL. */
const char *notice_now(const Notice *notice);

/* True if the line has changed since the last call: then a picture is due. */
bool notice_changed(Notice *notice);

/* Source of the window's states: a simulation or a recorded run, behind one interface with a table for
   each. */

struct PlayScene;

typedef struct StateSource {
    bool simulates; /* the box can be moved, solver keys can be set, the session can be saved */
    bool (*start)(struct PlayScene *open, const SimulatorSetup *how, Error *error);
    bool (*close)(struct PlayScene *open, double patience_ms); /* see play_scene_close */

    /* Does the due work; returns the ms until more is due: see simulator_work. */
    double (*work)(struct PlayScene *open, double budget_ms);
    void (*status)(struct PlayScene *open, SimulatorStatus *status);
    bool (*fresh)(struct PlayScene *open);
    bool (*take)(struct PlayScene *open, ParticleBuffers *out);
    bool (*has)(const struct PlayScene *open, const ViewDef *view, Error *error); /* the view's data */

    /* Time: see simulator_pause and the following functions. */
    void (*pause)(struct PlayScene *open, bool paused);
    void (*step)(struct PlayScene *open, int frames, bool held); /* 1 or -1, then paused */
    void (*go_by)(struct PlayScene *open, double seconds);
    void (*go_to)(struct PlayScene *open, double time);
    void (*set_speed)(struct PlayScene *open, double speed);
    void (*reset)(struct PlayScene *open); /* to the start */
} StateSource;

extern const StateSource state_source_simulator; /* play_scene.c */
extern const StateSource state_source_recorded;  /* source_recorded.c */

/* The open scene: its file, and the source of its states: a simulator with an upload to the GPU, or a player
   of a recorded run. */

typedef struct PlayScene {
    Scene scene;         /* the present scene: the file's values with later changes */
    Notes notes;         /* notes on the present scene */
    Recording recording; /* the file's text and the settings: the start of the session */
    char
        *reloaded; /* the file's text after a save merged into the running scene; NULL: use the recording's */
    size_t reloaded_size;
    bool session;   /* a recorded session with commands, to be played */
    Upload *upload; /* with all scalars, so that colours may change at once; NULL on a GPU */
    Simulator *simulator;
    Recorded *recorded; /* of a file of snapshots; the player has taken its content */
    Player *player;
    CompareRuns *compared;     /* runs shown beside the scene; NULL: none */
    const StateSource *source; /* NULL: no scene is open */
} PlayScene;

/* Reads a scene without starting anything. `settings`: of the command line, or NULL. Returns false with the
   loader's message; `notes` as of scene_load, not NULL. */
bool play_scene_read(PlayScene *open, const char *name, const SceneSettings *settings, Notes *notes,
                     Error *error);

/* Updates the notes on the present scene after a change of the key at `path` (NULL: after reading); new notes
   also go into `fresh` (may be NULL). */
void play_scene_advise(PlayScene *open, const char *path, Notes *fresh);

/* Starts the simulation; needs the context. `how`: all fields except scene, recording and upload. */
bool play_scene_start(PlayScene *open, const SimulatorSetup *how, Error *error);

/* Continues with the backend that the command sets. Returns false as simulator_move does. */
bool play_scene_set_backend(PlayScene *open, const SimCommand *command, Error *error);

/* Returns false if the solver still runs after `patience_ms`: then nothing is freed. A zeroed scene is
   allowed. */
bool play_scene_close(PlayScene *open, double patience_ms);

/* The scene file `by` places after `path` in its folder, in order of names, in a circle; false if there is no
   other. */
bool play_scene_neighbour(const char *path, int by, char out[1024]);

/* A second thread that ends the program if the window cannot: when the display is gone and a driver waits
   forever, or when a signal comes during a long operation. Saves the session. */

typedef struct Watchdog Watchdog;

/* Starts the guard. `record`: file for the session (may be NULL); `connection`: the display's file
   descriptor, or -1. Returns NULL on failure. */
Watchdog *watchdog_create(const char *record, int connection);

/* Sets the simulator to save; NULL: none, effective on return. A NULL guard is allowed. */
void watchdog_watch(Watchdog *guard, Simulator *simulator);

/* Stops the guard, if the window ends by itself; if the guard is already ending the program, never
   returns. */
void watchdog_destroy(Watchdog *guard);

/* File for the session at such an end: `record`; otherwise, with unsaved changes, a new file, except after
   Ctrl-C. Returns false if the session is not saved. */
bool watchdog_session_path(const char *record, bool unsaved, char path[1024]);

/* The model of the window: the open scene, its source (simulator or recorded run) and its newest state. */

/* Zero-initialise all but the given fields. */
typedef struct PlayModel {
    Window *window;         /* given: waits take events, new states wake the window */
    GlTimer *timer;         /* given: see SimulatorSetup */
    BoxControl *control;    /* given: sends the hand's target of the box */
    Notice *notice;         /* given */
    struct Watchdog *guard; /* given: guards the open session; NULL: no guard */
    const char *record;     /* given: with a path every session is saved; or NULL */
    bool kept;              /* with `record`: the session about to be left is already saved */
    size_t history_bytes;   /* given: see SimulatorSetup */
    double speed;           /* given: simulated seconds per second */

    PlayScene open;
    PlayScene left;            /* previous scene, whose solver is still ending; or zero */
    Scene file_scene;          /* as in the file */
    ParticleBuffers particles; /* the drawn state */
    bool has_particles;
    bool held; /* the clock waits for the first picture of the scene */
    SimulatorStatus status;
    bool paused;
    double simulated_s;        /* of earlier scenes, minus the time before the first picture */
    char user_view[NAME_SIZE]; /* view kept for the next scene, chosen by the user; "": the file's view */
    size_t scenes_opened;
    size_t seeded;            /* count of particles at the scene's start */
    unsigned saves, messages; /* reported so far */
    ScriptState last_script;  /* last reported */
    uint64_t closed_gates;    /* gates to close: world_close_gates */
    unsigned travels;         /* last handled SimulatorHistory.travels */
    unsigned solids;          /* SimulatorStatus.solids */
    atomic_bool pulled;       /* the user tried to move the box of a recorded run */
    bool fixed_reported;      /* reported that the box cannot move */
    bool asked_acceleration; /* a view reads accelerations, and the solver was asked once: the change may take
                                long */
} PlayModel;

/* Opens a file as a scene, with settings or NULL; the previous scene ends. On failure the previous scene
   stays. */
bool model_open(PlayModel *model, const char *scene, const SceneSettings *settings, Error *error);

/* Opens the next (`by` 1) or previous (-1) scene of the folder, with the user's view, if any; reports and
   skips broken scenes. Returns false if there is no other scene. */
bool model_open_neighbour(PlayModel *model, int by);

/* True if the previous scene has ended. */
bool model_end_previous(PlayModel *model, double patience_ms);

/* Ends all. Returns false if a solver did not end in time: then free nothing that the solver uses. */
bool model_close(PlayModel *model, double patience_ms);

/* Reads the solver's status, and shows its messages. */
void model_read_status(PlayModel *model);

/* Takes the newest state, and the states of runs shown beside the scene. */
void model_take_state(PlayModel *model);

/* True if there is a state not taken yet. */
bool model_has_new_state(const PlayModel *model);

/* State and world shown by a view. */
const ParticleBuffers *model_state(const PlayModel *model, const ViewDef *view);
const WorldDef *model_world(const PlayModel *model, const ViewDef *view);

/* Names and differences of `count` panels with these views; returns false if all show the scene, without
   titles. */
bool model_titles(const PlayModel *model, const ViewDef *const views[], int count, Title titles[PANELS_MAX]);

/* True if the view's source has all data that the view reads. */
bool model_has(const PlayModel *model, const ViewDef *view, Error *error);

/* Call after each picture with a state: from the first of a scene on time runs, if the user has not paused
   it. So nobody misses the beginning while shaders compile. */
void model_shown(PlayModel *model);

void model_pause(PlayModel *model, bool paused);
void model_step(PlayModel *model, bool held); /* one frame, then a pause; `held`: see simulator_single_step */
void model_step_back(PlayModel *model, bool held); /* one frame back, then a pause */
void model_go_by(PlayModel *model,
                 double seconds); /* forward or back, within the kept past; time runs or rests as before */
void model_go_to(PlayModel *model, double time); /* see simulator_go_to */
void model_loop(PlayModel *model);               /* toggles: a recorded run repeats at its end, or stops */
void model_reset(PlayModel *model);
void model_set_speed(PlayModel *model, double factor); /* multiplies the present speed, within bounds */

/* Sets "path=value" of a live key: in the scene at once, for the solver from its next step on. Returns false
   without changes. */
bool model_set(PlayModel *model, const char *setting);

/* The same with a value. */
bool model_set_value(PlayModel *model, const SettingValue *value);

/* Closes the gates of emitters and drains in `gates` from the next step on, and opens the rest. */
void model_set_gates(PlayModel *model, uint64_t gates);

/* Sets or removes a finger in the fluid from the next step on. Returns the command's number; 0: refused. */
uint64_t model_touch(PlayModel *model, const Finger *finger);

/* Changes a solid from the next step on. Returns false, with a message, if impossible. */
bool model_solid(PlayModel *model, const SolidCommand *command);

/* Resizes the box (m), as fast as the walls may move. Returns false, with a message, if impossible. */
bool model_resize(PlayModel *model, const double size[3]);

/* Call after a change of views: solvers begin to keep data read by a view. A solver that could not is asked
   again after the data was unread for a while. */
void model_follow_views(PlayModel *model);

/* Stops the box at its place. */
void model_stop_box(PlayModel *model);

/* Saves the session so far into a new file: in the background; or at once, waiting for the result. */
void model_save(PlayModel *model);
bool model_save_now(PlayModel *model, const char *path, Error *error);

/* With --record: saves the session under a new name before leaving, unless it made no step. Returns false
   with the reason. */
bool model_save_before_leaving(PlayModel *model, Error *error);

/* Reopens the open scene: with its present file, or with different settings. The window's changes of
   settings, views and camera stay. */

/* The scene of the file and the command line, the present scene, and the settings that turn the first into
   the second. Returns false if the file's text is no longer valid, which callers cannot mend. */
typedef struct SceneEdits {
    Scene filed, now;
    SceneDifference changes; /* free with setting_list_free */
} SceneEdits;

/* The last read text of the scene's file, without a final 0. */
const char *scene_edits_text(const PlayScene *open, size_t *size);

/* Restarts the scene with additional settings, which override settings of the same key. `particles` more than
   0: with about so many particles. Saves an unsaved session first. Returns false without changes. */
bool scene_restart(PlayModel *model, const SettingList *more, size_t particles, Error *error);

/* Saves the scene with its present settings as a new file in the present folder; reports the result. */
void scene_edits_save(PlayModel *model);

/* Makes the same text for embedding in a picture; free with embedded_scene_free. */
bool scene_edits_embed(const PlayModel *model, EmbeddedScene *out, Error *error);

typedef enum ReloadResult {
    RELOAD_FAILED,   /* unreadable; no changes */
    RELOAD_LATER,    /* the previous scene is still ending: retry in a moment */
    RELOAD_SAME,     /* no relevant changes */
    RELOAD_LIVE,     /* the running scene has the changes */
    RELOAD_VIEW,     /* like RELOAD_LIVE, with a changed picture */
    RELOAD_RESTARTED /* restarted */
} ReloadResult;

/* Call after a write to the scene's file, or with `others` to a file named by the scene. `words` describe the
   changes. */
ReloadResult scene_reload(PlayModel *model, bool others, char words[320], Error *error);

#endif
