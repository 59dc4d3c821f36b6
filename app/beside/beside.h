/* Views beside the scene: a recorded run, or the scene with settings of its own (`file` and `set` of an
   entry of `views`). */
#ifndef SLOSH_BESIDE_H
#define SLOSH_BESIDE_H

#include "app/playback/recorded.h"
#include "app/scene/scene.h"

/* beside_is: true if the view shows something other than the scene. beside_same: true if two views show
   the same. */
bool beside_is(const ViewDef *view);
bool beside_same(const ViewDef *a, const ViewDef *b);

enum { BESIDE_WORDS = 160 };

/* Fills in the view's name: "run.h5part", "particles.spacing 0.01, gravity [0, -3, 0]"; "" for the scene
   itself. */
void beside_words(const ViewDef *view, char words[BESIDE_WORDS]);

/* Settings of the command line, followed by settings of a view. Contains pointers into itself: do not
   move. */
typedef struct BesideSettings {
    SceneSettings settings;
    char set[VIEW_SET_SIZE];
    char said[SCENE_SETTINGS_MAX][64 + VIEW_SET_SIZE / 4]; /* "views[1].set gravity=[0, -3, 0]" */
} BesideSettings;

/* Joins settings. `entry`: index in `views`, for messages. `base` may be NULL. Returns false if there are
   too many settings. */
bool beside_settings(const SceneSettings *base, const ViewDef *view, int entry, BesideSettings *out,
                     Error *error);

/* Returns true if simulated states have, or can have from now on, all attributes read by the view; false
   with the missing attributes. */
bool beside_simulated_has(const WorldDef *def, const ViewDef *view, Error *error);

/* PARTICLE_*: attributes a simulation can provide, out of all read by views. */
unsigned beside_simulated_attributes(const WorldDef *def);

/* Greatest count of particles of a simulation, including poured particles. */
size_t beside_simulated_room(const WorldDef *def);

/* Opens the view's file, relative to the folder of the scene `scene`; notes on the file go into `notes`.
   Returns false with the reason: as recorded_open, or the file lacks attributes read by the view. */
bool beside_open_file(const char *scene, const ViewDef *view, int entry, Recorded *out, Notes *notes,
                      Error *error);

#endif
