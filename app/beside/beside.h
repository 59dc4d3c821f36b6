/* What a picture among several shows beside the scene: a recorded run, or the scene with settings of its own
   (`file` and `set` of an entry of `views`). */
#ifndef SLOSH_BESIDE_H
#define SLOSH_BESIDE_H

#include "app/playback/recorded.h"
#include "app/scene/scene.h"

/* Whether the view shows something else than the scene; whether two show the same. */
bool beside_is(const ViewDef *view);
bool beside_same(const ViewDef *a, const ViewDef *b);

enum { BESIDE_WORDS = 160 };

/* What it is called: "run.h5part", "particles.spacing 0.01, gravity [0, -3, 0]"; "" of the scene itself. */
void beside_words(const ViewDef *view, char words[BESIDE_WORDS]);

/* Settings of the command line with those of a view behind them. To be left where it is: it points into
   itself. */
typedef struct BesideSettings {
    SceneSettings settings;
    char set[VIEW_SET_SIZE];
    char said[SCENE_SETTINGS_MAX][64 + VIEW_SET_SIZE / 4]; /* "views[1].set gravity=[0, -3, 0]" */
} BesideSettings;

/* `entry`: of `views`, for messages. `base` may be NULL. False where there are too many. */
bool beside_settings(const SceneSettings *base, const ViewDef *view, int entry, BesideSettings *out,
                     Error *error);

/* Whether states that are simulated so have, or could have from now on, all that the view reads; false with
   what they lack. */
bool beside_simulated_has(const WorldDef *def, const ViewDef *view, Error *error);

/* PARTICLE_*: what such states may come to have, of all that views read. */
unsigned beside_simulated_attributes(const WorldDef *def);

/* Particles that such states may come to have, what a user pours included. */
size_t beside_simulated_room(const WorldDef *def);

/* Opens the view's file, found from the folder of the scene at that path; what is to be said of the file goes
   into `notes`. False with the reason: as of recorded_open, or it lacks what the view reads. */
bool beside_open_file(const char *scene, const ViewDef *view, int entry, Recorded *out, Notes *notes,
                      Error *error);

#endif
