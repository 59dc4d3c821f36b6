/* What is shown in the window: the scene that is open, its source, simulator or recorded run, and the newest
   state of it. */
#ifndef SLOSH_PLAY_MODEL_H
#define SLOSH_PLAY_MODEL_H

#include "app/held/hand_post.h"
#include "app/play/notice.h"
#include "app/play/scene.h"
#include "app/window/window.h"
#include "sim/gl/timer.h"

#include <stdatomic.h>

/* To be zeroed but for what is given. */
typedef struct Model {
    Window *window;      /* given: waits take its events, a new state wakes it */
    GlTimer *timer;      /* given: as of SimulatorSetup */
    HandPost *post;      /* given: sends the box where the hand wants it */
    Notice *notice;      /* given */
    struct Guard *guard; /* given: watches the session of what is open; NULL: nothing does */
    const char *record;  /* given: no session goes without a trace; or NULL */
    bool kept;           /* with it the session that is left next is saved already */
    size_t past_bytes;   /* given: as of SimulatorSetup */
    double speed;        /* given: simulated seconds in a second */

    PlayScene open;
    PlayScene left;            /* the one before, whose solver has not ended yet; or zero */
    Scene file_scene;          /* as its file has it */
    ParticleBuffers particles; /* what is drawn */
    bool has_particles;
    SimulatorStatus status;
    bool paused;
    double simulated_s;        /* of the scenes before, less what was simulated before the first picture */
    char kept_view[NAME_SIZE]; /* that the user chose, and the next scene is to have; "": as its file says */
    size_t scenes_opened;
    size_t seeded;            /* particles of the open scene at its start */
    unsigned saves, messages; /* that were told */
    ScriptState told_script;  /* that was told */
    uint64_t shut;            /* gates that shall be: world_shut */
    unsigned travels;         /* SimulatorPast.travels that were followed; */
    unsigned solids;          /* SimulatorStatus.solids */
    atomic_bool pulled;       /* somebody would move the box of a recorded run; */
    bool told_fixed;          /* it was told that none can */
    bool asked_acceleration;  /* a view reads it, and the solver was asked for it: once, it may take long */
} Model;

/* A file as a scene, with settings of its own or NULL; the scene before ends. On failure that one stays. */
bool model_open(Model *model, const char *scene, const SceneSettings *settings, Error *error);

/* The scene before or after it in its folder, by the view that the user chose, if there is one; one that is
 * broken is told and left out. False: there is none.
 */
bool model_open_neighbour(Model *model, int by);

/* Whether the scene that was open before has ended. */
bool model_leave(Model *model, double patience_ms);

/* Ends all. False when a solver did not end in time: then nothing that it uses may be freed. */
bool model_close(Model *model, double patience_ms);

/* Asks the solver how it stands, and shows what it has to say. */
void model_listen(Model *model);

/* Takes the newest state, and those of what is shown beside it. */
void model_take(Model *model);

/* Whether there is one that was not taken. */
bool model_fresh(const Model *model);

/* What a view shows: the state that was taken, and its world. */
const ParticleBuffers *model_state(const Model *model, const ViewDef *view);
const WorldDef *model_world(const Model *model, const ViewDef *view);

/* Of `count` panels with these views, the name of each and in what they differ; false: all show the scene,
   and have no titles. */
bool model_titles(const Model *model, const ViewDef *const views[], int count, Title titles[PANELS_MAX]);

/* Whether what the view shows has all that it reads. */
bool model_has(const Model *model, const ViewDef *view, Error *error);

void model_pause(Model *model, bool paused);
void model_step(Model *model, bool held); /* one frame, then a pause; `held`: as of simulator_single_step */
void model_step_back(Model *model, bool held); /* the same, one frame back */
void model_go_by(Model *model,
                 double seconds);            /* on or back, as far as it goes; time runs or rests as it did */
void model_go_to(Model *model, double time); /* as of simulator_go_to */
void model_loop(Model *model);               /* whether a recorded run begins anew at its end, or stops */
void model_reset(Model *model);
void model_set_speed(Model *model, double factor); /* so many times the present one, within bounds */

/* "path=value" of a live key: in the scene now, for the solver from its next step on. False: all stays. */
bool model_set(Model *model, const char *setting);

/* These gates of emitters and drains are shut from the next step on, the others open. */
void model_shut(Model *model, uint64_t gates);

/* A finger in the fluid from the next step on, or none. The number of its command; 0: it was not taken. */
uint64_t model_touch(Model *model, const Finger *finger);

/* Something is done to a solid from the next step on. False, with a word to the user: it cannot be here. */
bool model_solid(Model *model, const SolidCommand *command);

/* The box goes to that size (m), as fast as its walls may. False, with a word: it cannot here. */
bool model_resize(Model *model, const double size[3]);

/* The views have changed: solvers begin to keep what one of them reads. One that cannot is asked again when
   it was not read meanwhile. */
void model_follow_views(Model *model);

/* The box stops where it is. */
void model_let_go(Model *model);

/* The session so far into a new file, behind the window's back; or at once, and waits for it. */
void model_save(Model *model);
bool model_save_now(Model *model, const char *path, Error *error);

/* With --record: saves it under a name of its own before it is left, when it has gone on at all. False with
   the reason. */
bool model_keep_session(Model *model, Error *error);

#endif
