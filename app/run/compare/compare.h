/* Runs shown next to the scene, as views with `file` or `set` ask for: titles of panels (PanelFacts),
   settings and files of such views (CompareSettings), and the runs of the window (CompareRuns). */
#ifndef APP_RUN_COMPARE_COMPARE_H
#define APP_RUN_COMPARE_COMPARE_H

#include "app/run/playback/playback.h"
#include "app/run/recording/sim_command.h"
#include "app/run/simulator.h"
#include "app/scene/scene.h"
#include "render/frame/passes.h"
#include "sim/gpu/particle_buffers.h"
#include "slosh/def.h"

#include <stdbool.h>
#include <stddef.h>

/* Titles of panels with different states: name and differences. */

/* Facts of a panel. */
typedef struct PanelFacts {
    const char *words; /* its name; "": none */
    const char *said;  /* lines "path=value": settings contained in the name */
    const WorldDef *def;
    size_t particles;
    double spacing;     /* m */
    bool recorded;      /* from a file: method and step are unknown */
    bool failed;        /* the simulation has stopped */
    double time;        /* of the shown state, s */
    double first, last; /* of a file: times of first and last step, s */
    double wanted;      /* of a file: requested time, s */
} PanelFacts;

/* Makes the title of one of `count` panels: its name, and below the differences between panels; for a file
   also a note if its times do not reach the requested time. `unnamed`: replaces an empty name. */
void panel_title(const PanelFacts facts[], int count, int panel, const char *unnamed, Title *title);

/* Views beside the scene: a recorded run, or the scene with settings of its own (`file` and `set` of an
   entry of `views`). */

/* compare_is_other: true if the view shows something other than the scene. compare_is_same: true if two views
   show the same. */
bool compare_is_other(const ViewDef *view);
bool compare_is_same(const ViewDef *a, const ViewDef *b);

enum { COMPARE_NAME_SIZE = 160 };

/* Fills in the view's name: "run.h5part", "particles.spacing 0.01, gravity [0, -3, 0]"; "" for the scene
   itself. */
void compare_name(const ViewDef *view, char words[COMPARE_NAME_SIZE]);

/* Settings of the command line, followed by settings of a view. Contains pointers into itself: do not
   move. */
typedef struct CompareSettings {
    SceneSettings settings;
    char set[VIEW_SET_SIZE];
    char said[SCENE_SETTINGS_MAX][64 + VIEW_SET_SIZE / 4]; /* "views[1].set gravity=[0, -3, 0]" */
} CompareSettings;

/* Joins settings. `entry`: index in `views`, for messages. `base` may be NULL. Returns false if there are
   too many settings. */
bool compare_settings(const SceneSettings *base, const ViewDef *view, int entry, CompareSettings *out,
                      Error *error);

/* Returns true if simulated states have, or can have from now on, all attributes read by the view; false
   with the missing attributes. */
bool compare_simulated_has(const WorldDef *def, const ViewDef *view, Error *error);

/* PARTICLE_*: attributes a simulation can provide, out of all read by views. */
unsigned compare_simulated_attributes(const WorldDef *def);

/* Greatest count of particles of a simulation, including poured particles. */
size_t compare_simulated_particles(const WorldDef *def);

/* Opens the view's file, relative to the folder of the scene `scene`; notes on the file go into `notes`.
   Returns false with the reason: as recorded_open, or the file lacks attributes read by the view. */
bool compare_open_file(const char *scene, const ViewDef *view, int entry, Recorded *out, Notes *notes,
                       Error *error);

/* Companions of the window's scene: recorded runs, and the scene with other settings, run by a following
   simulator. All show the time of the scene's newest state: each its first state at or after that time.

   All functions except compare_send belong to the thread of the GL context. */

typedef struct CompareRuns CompareRuns;

typedef struct CompareSetup {
    const Scene *scene; /* with the views; not needed afterwards */
    const char *text;   /* text of the scene's file; NULL: a recorded run, where views cannot have settings */
    size_t size;
    const SceneSettings *settings; /* of the command line; NULL: none */
} CompareSetup;

/* Reads everything; starts nothing. *out is NULL if no view shows anything beside the scene. Returns false
   with the reason; notes go into `notes`. */
bool compare_read(const CompareSetup *setup, CompareRuns **out, Notes *notes, Error *error);

/* compare_start: starts the companions, with pause, wake and past of `how`. compare_followers: fills in
   the simulators that must follow the scene's simulator; returns their count. */
bool compare_start(CompareRuns *compared, const SimulatorSetup *how, Error *error);
int compare_followers(const CompareRuns *compared, Simulator *out[SIMULATOR_FOLLOWERS]);

/* Returns the definitions of the simulated worlds, before compare_start, to set machine-dependent values.
   NULL after the last. */
WorldDef *compare_world_def(CompareRuns *compared, int index);

/* Call after the end of the followed simulator; NULL is allowed. */
void compare_destroy(CompareRuns *compared);

/* Sends a command to all simulated companions. Settings overridden by a view are skipped. */
void compare_send(CompareRuns *compared, const SimCommand *command);

/* Makes the view's companion compute accelerations from its next step on. */
void compare_want_accelerations(CompareRuns *compared, const ViewDef *view);

/* compare_has_new: true if there is a new state. compare_take: takes the states for the scene's state at
   `time`; returns false while a companion has no state at all and has not failed. A failed companion has
   no particles. */
bool compare_has_new(CompareRuns *compared);
bool compare_take(CompareRuns *compared, double time);

/* State and world of a view; NULL: the scene's. */
const ParticleBuffers *compare_state(const CompareRuns *compared, const ViewDef *view);
const WorldDef *compare_world(const CompareRuns *compared, const ViewDef *view);

/* Fills in `facts`, with the name, for a view beside the scene. */
void compare_facts(const CompareRuns *compared, const ViewDef *view, PanelFacts *facts);

/* Returns true if the companion has all attributes read by the view. */
bool compare_has_attributes(const CompareRuns *compared, const ViewDef *view, Error *error);

bool compare_reload(CompareRuns *compared, Error *error); /* see simulator_reload */

/* Fills in a new message of a companion, with its name; returns false if there is none. */
bool compare_message(CompareRuns *compared, char words[1280]);

#endif
