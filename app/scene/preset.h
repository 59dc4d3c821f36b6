/* `solver.preset`: settings that go together under one name. A preset fills in what a scene does not name;
   what the scene or --set names stays. */
#ifndef SLOSH_SCENE_PRESET_H
#define SLOSH_SCENE_PRESET_H

#include "app/scene/scene.h"
#include "app/yaml/tree.h"

#include <stdio.h>

enum { PRESET_SETTINGS_MAX = 20, PRESET_SEVERAL = 1 };

typedef struct PresetSetting {
    const char *path, *value;
    const char *method; /* the only one that it is for; NULL: all */
    int scenes;         /* 2, 3: of such dimensions alone; PRESET_SEVERAL: of two fluids or more; 0: all */
    const char *unless; /* a key that goes with it: a scene that names the one chooses the other; or NULL */
} PresetSetting;

typedef struct Preset {
    const char *name, *help;
    PresetSetting
        settings[PRESET_SETTINGS_MAX]; /* ended by a NULL path; a later one goes before an earlier */
} Preset;

/* Ended by a NULL name; the first is the default. */
extern const Preset preset_list[];

/* Puts what the preset that `tree` names fills in into `scene`, which has its defaults: before the tree is
   read. A name that is no preset fills in nothing. */
bool preset_apply(const Tree *tree, Scene *scene, Error *error);

/* Whether the key's value came from the scene's preset. */
bool preset_gave(const Scene *scene, const char *path);

/* A line for each key that the scene's preset has a value for: the value, or that the scene names another. */
void preset_print(const Scene *scene, FILE *file);

#endif
