/* `solver.preset`: a named group of settings. A preset fills in keys missing in the scene; keys of the scene
   or of --set stay. */
#ifndef SLOSH_SCENE_PRESET_H
#define SLOSH_SCENE_PRESET_H

#include "app/scene/scene.h"
#include "app/yaml/tree.h"

#include <stdio.h>

enum { PRESET_SETTINGS_MAX = 20, PRESET_SEVERAL = 1 };

typedef struct PresetSetting {
    const char *path, *value;
    const char *method; /* the row's only method; NULL: all methods */
    int scenes; /* 2, 3: only scenes of such dimensions; PRESET_SEVERAL: two or more fluids; 0: all scenes */
    const char *unless; /* a related key: a scene that names this key does not get the row; or NULL */
} PresetSetting;

typedef struct Preset {
    const char *name, *help;
    PresetSetting
        settings[PRESET_SETTINGS_MAX]; /* ended by a NULL path; a later row overrides an earlier row */
} Preset;

/* Ended by a NULL name; the first is the default. */
extern const Preset preset_list[];

/* Fills the settings of the preset named by `tree` into `scene`, which has its defaults; call before reading
   the tree. An unknown preset changes nothing. */
bool preset_apply(const Tree *tree, Scene *scene, Error *error);

/* True if the key's value came from the scene's preset. */
bool preset_gave(const Scene *scene, const char *path);

/* Prints a line per key of the scene's preset: the value, or the scene's own setting. */
void preset_print(const Scene *scene, FILE *file);

#endif
