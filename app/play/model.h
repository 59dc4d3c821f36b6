/* The model of the window: the open scene, its source (simulator or recorded run) and its newest state. */
#ifndef SLOSH_PLAY_MODEL_H
#define SLOSH_PLAY_MODEL_H

#include "app/input/box_control.h"
#include "app/play/notice.h"
#include "app/play/scene.h"
#include "app/window/window.h"
#include "sim/gl/timer.h"

#include <stdatomic.h>

/* Zero-initialise all but the given fields. */
typedef struct Model {
    Window *window;       /* given: waits take events, new states wake the window */
    GlTimer *timer;       /* given: see SimulatorSetup */
    BoxControl *control;  /* given: sends the hand's target of the box */
    Notice *notice;       /* given */
    struct Guard *guard;  /* given: guards the open session; NULL: no guard */
    const char *record;   /* given: with a path every session is saved; or NULL */
    bool kept;            /* with `record`: the session about to be left is already saved */
    size_t history_bytes; /* given: see SimulatorSetup */
    double speed;         /* given: simulated seconds per second */

    PlayScene open;
    PlayScene left;            /* previous scene, whose solver is still ending; or zero */
    Scene file_scene;          /* as in the file */
    ParticleBuffers particles; /* the drawn state */
    bool has_particles;
    SimulatorStatus status;
    bool paused;
    double simulated_s;        /* of earlier scenes, minus the time before the first picture */
    char kept_view[NAME_SIZE]; /* view kept for the next scene, chosen by the user; "": the file's view */
    size_t scenes_opened;
    size_t seeded;            /* count of particles at the scene's start */
    unsigned saves, messages; /* reported so far */
    ScriptState told_script;  /* last reported */
    uint64_t shut;            /* gates to close: world_shut */
    unsigned travels;         /* last handled SimulatorHistory.travels */
    unsigned solids;          /* SimulatorStatus.solids */
    atomic_bool pulled;       /* the user tried to move the box of a recorded run */
    bool told_fixed;          /* reported that the box cannot move */
    bool asked_acceleration; /* a view reads accelerations, and the solver was asked once: the change may take
                                long */
} Model;

/* Opens a file as a scene, with settings or NULL; the previous scene ends. On failure the previous scene
   stays. */
bool model_open(Model *model, const char *scene, const SceneSettings *settings, Error *error);

/* Opens the next (`by` 1) or previous (-1) scene of the folder, with the user's view, if any; reports and
   skips broken scenes. Returns false if there is no other scene. */
bool model_open_neighbour(Model *model, int by);

/* True if the previous scene has ended. */
bool model_leave(Model *model, double patience_ms);

/* Ends all. Returns false if a solver did not end in time: then free nothing that the solver uses. */
bool model_close(Model *model, double patience_ms);

/* Reads the solver's status, and shows its messages. */
void model_listen(Model *model);

/* Takes the newest state, and the states of runs shown beside the scene. */
void model_take(Model *model);

/* True if there is a state not taken yet. */
bool model_fresh(const Model *model);

/* State and world shown by a view. */
const ParticleBuffers *model_state(const Model *model, const ViewDef *view);
const WorldDef *model_world(const Model *model, const ViewDef *view);

/* Names and differences of `count` panels with these views; returns false if all show the scene, without
   titles. */
bool model_titles(const Model *model, const ViewDef *const views[], int count, Title titles[PANELS_MAX]);

/* True if the view's source has all data that the view reads. */
bool model_has(const Model *model, const ViewDef *view, Error *error);

void model_pause(Model *model, bool paused);
void model_step(Model *model, bool held); /* one frame, then a pause; `held`: see simulator_single_step */
void model_step_back(Model *model, bool held); /* one frame back, then a pause */
void model_go_by(Model *model,
                 double seconds); /* forward or back, within the kept past; time runs or rests as before */
void model_go_to(Model *model, double time); /* see simulator_go_to */
void model_loop(Model *model);               /* toggles: a recorded run repeats at its end, or stops */
void model_reset(Model *model);
void model_set_speed(Model *model, double factor); /* multiplies the present speed, within bounds */

/* Sets "path=value" of a live key: in the scene at once, for the solver from its next step on. Returns false
   without changes. */
bool model_set(Model *model, const char *setting);

/* Closes the gates of emitters and drains in `gates` from the next step on, and opens the rest. */
void model_shut(Model *model, uint64_t gates);

/* Sets or removes a finger in the fluid from the next step on. Returns the command's number; 0: refused. */
uint64_t model_touch(Model *model, const Finger *finger);

/* Changes a solid from the next step on. Returns false, with a message, if impossible. */
bool model_solid(Model *model, const SolidCommand *command);

/* Resizes the box (m), as fast as the walls may move. Returns false, with a message, if impossible. */
bool model_resize(Model *model, const double size[3]);

/* Call after a change of views: solvers begin to keep data read by a view. A solver that could not is asked
   again after the data was unread for a while. */
void model_follow_views(Model *model);

/* Stops the box at its place. */
void model_let_go(Model *model);

/* Saves the session so far into a new file: in the background; or at once, waiting for the result. */
void model_save(Model *model);
bool model_save_now(Model *model, const char *path, Error *error);

/* With --record: saves the session under a new name before leaving, unless it made no step. Returns false
   with the reason. */
bool model_keep_session(Model *model, Error *error);

#endif
