/* Runs shown next to the scene, as views with `file` or `set` ask for. Here are titles of panels
   (PanelFacts), settings and files of such views (CompareSettings), and the runs of the window (CompareRuns).
 */
#ifndef APP_RUN_COMPARE_COMPARE_H
#define APP_RUN_COMPARE_COMPARE_H

#include "app/files/pictures.h"
#include "app/run/playback/playback.h"
#include "app/run/recording/recording.h"
#include "app/run/session.h"
#include "app/run/simulator.h"
#include "app/scene/scene.h"
#include "render/frame/passes.h"
#include "render/particles/particles.h"
#include "render/renderer.h"
#include "sim/def.h"
#include "sim/gpu/particle_buffers.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

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
    double wanted;      /* requested time, s */
} PanelFacts;

/* Makes the title of one of `count` panels: its name, and below the differences between panels; for a file
   also a note if its times do not reach the requested time. `unnamed`: replaces an empty name. */
void panel_title(const PanelFacts facts[], int count, int panel, const char *unnamed, Title *title);

/* Views beside the scene: a recorded run, or the scene with settings of its own (`file` and `set` of an
   entry of `views`). */

/* compare_is_other: true if the view shows something other than the scene at its time. compare_is_same: true
   if two views show the same. */
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

/* Opens the view's file, relative to the folder of the scene `scene`, or without one `scene` itself, a
   recorded run; notes on the file go into `notes`. Returns false with the reason: as recorded_open, or the
   file lacks attributes read by the view. */
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

/* Pictures of sessions and recorded runs side by side, for `render`, and their missing attributes. */

/* Attributes missing in pictures, reported once at the end. */

enum { MISSING_ATTRIBUTES_SIZE = 512 };

/* Zero-initialise before use. */
typedef struct MissingAttributes {
    int panels;
    size_t drawn; /* pictures */
    struct PanelMissing {
        size_t pictures;                     /* pictures with missing attributes */
        double first;                        /* time of the first such picture, s */
        char words[MISSING_ATTRIBUTES_SIZE]; /* missing attributes */
    } of[PANELS_MAX];
} MissingAttributes;

/* Call after a picture of the given states. */
void missing_attributes_add(MissingAttributes *missing, const Panels *panels,
                            const ParticleBuffers *const states[]);

/* Prints a line for each panel with missing attributes; `output`: name of the pictures. */
void missing_attributes_print(const MissingAttributes *missing, const char *output, FILE *file);

/* Pictures of one or several sessions at the same time, and of recorded runs, each in its panels. */

/* Contents of a panel; all pointers must outlive the pictures. */
typedef struct PicturePanel {
    const Session *session;
    Recorded *recorded;   /* instead of a session; its reader is taken over, the rest stays */
    const Session *scene; /* session giving the time for a run; NULL: the picture's time */
    const ViewDef *view;  /* stays valid, with the time of the states, if any; pictures follow changes */
} PicturePanel;

/* A session or run: its state on the GPU, for all its panels. */
typedef struct PictureSource {
    const Session *session; /* NULL: a run */
    Recorded *recorded;
    const Session *scene; /* of a run: see PicturePanel */
    Prefetch *prefetch;
    PrefetchStatus at; /* in the last picture */
    PrefetchWatch prefetch_watch;
    unsigned attributes; /* read by its views */
    double time;         /* of the states, s; below 0: the picture's */
    Upload *upload;      /* NULL: the world's particles are on the GPU */
    size_t capacity;     /* capacity of both, particles; a recorded session may raise the world's count */
    Upload *upload_interpolated;      /* for interpolated states; NULL: none yet */
    StateCopy before, after, between; /* states before and after the last step, and the interpolated state */
    ParticleBuffers state;            /* in the last picture */
    bool is_interpolated, taken;      /* the state is interpolated; there is a state */
    double every, before_picture; /* interval of states for overlays, and for how long before a picture, s */
    double watched;               /* time of the last state seen by overlays, s */
} PictureSource;

typedef struct PanelPictures {
    Panels *panels;
    int source_count;
    PictureSource sources[PANELS_MAX];
    int source_of[PANELS_MAX];        /* per panel */
    const ViewDef *asked[PANELS_MAX]; /* the views of the callers' panels */
    ViewDef said[PANELS_MAX];         /* copies, of the last picture */
    ViewDef views[PANELS_MAX];        /* as drawn */
    int solids[PANELS_MAX];           /* count of shown solids */
    bool fresh;                       /* a state or a view has changed since the last picture */
    MissingAttributes missing;
    Image image; /* the last picture */
} PanelPictures;

/* Opens pictures for `count` panels, 1 to PANELS_MAX, in pictures of the given size; in the current
   context. On failure call panel_pictures_close as well. */
bool panel_pictures_open(PanelPictures *pictures, const PicturePanel panels[], int count, int width,
                         int height, Error *error);
void panel_pictures_close(PanelPictures *pictures); /* a zeroed one is allowed */

/* Call before each step of a session for pictures between two states, at even times. Keeps the state if
   the step can reach `time` (s), the time of the next picture. Without calls a picture shows the first state
   at or after its time. */
bool panel_pictures_keep(PanelPictures *pictures, const Session *session, double time, Error *error);

/* Call before each step: overlays following particles see states between pictures too (OverlayKind.every);
   `time` (s): of the next picture. */
bool panel_pictures_watch(PanelPictures *pictures, const Session *session, double time, Error *error);

/* panel_pictures_take: takes the states of the picture at `time` (s). panel_pictures_draw: draws into
   pictures->image, unless no state has changed since the last picture. */
bool panel_pictures_take(PanelPictures *pictures, double time, Error *error);
bool panel_pictures_draw(PanelPictures *pictures, Error *error);

/* Returns the time between the earliest and the latest state of the last picture, s; runs, and views with a
   time of their own, are ignored. */
double panel_pictures_spread(const PanelPictures *pictures);

/* Returns how late the latest state of the last picture is for a picture at `time` (s), s; runs are ignored.
 */
double panel_pictures_late(const PanelPictures *pictures, double time);

/* True if two panels of the last picture are equal below their titles, given one title per panel. */
bool panel_pictures_same(const PanelPictures *pictures, int a, int b, const Title titles[]);

/* Sets the title in the panel's corner, from the next picture on. */
bool panel_pictures_set_title(PanelPictures *pictures, int panel, const Title *title, Error *error);

#endif
