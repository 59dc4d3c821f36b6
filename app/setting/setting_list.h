/* A list of owned settings "path=value": differences found, or settings for reopening a scene. */
#ifndef SLOSH_SETTING_LIST_H
#define SLOSH_SETTING_LIST_H

#include "app/scene/scene.h"

enum { SETTING_LIST_MAX = 256 };

/* Zero: an empty list. */
typedef struct SettingList {
    int count;
    bool lacks; /* a setting was dropped: no room or no memory */
    char *set[SETTING_LIST_MAX];
} SettingList;

/* Adds a setting at the end; removes an earlier setting of the same path. */
void setting_list_add(SettingList *list, const char *setting);

/* Adds a setting with any text as its value. */
void setting_list_add_text(SettingList *list, const char *path, const char *text);

/* Adds all settings of `more` or of `settings`. */
void setting_list_join(SettingList *list, const SettingList *more);
void setting_list_join_scene(SettingList *list, const SceneSettings *settings);

/* Remove settings. remove: of the paths in `paths`. around: whole lists ("solids=[{...}]") if `paths` has a
   key of an element ("solids[0].slip"). within: keys of elements of lists that are whole in `paths`. under:
   settings that begin with `begin`. */
void setting_list_remove(SettingList *list, const SettingList *paths);
void setting_list_remove_around(SettingList *list, const SettingList *paths);
void setting_list_remove_within(SettingList *list, const SettingList *paths);
void setting_list_remove_under(SettingList *list, const char *begin);

/* Points `out` at the settings, valid while the list lives. Returns false if there are more than
   SCENE_SETTINGS_MAX, or if the list lacks some. */
bool setting_list_settings(const SettingList *list, SceneSettings *out, Error *error);

void setting_list_free(SettingList *list); /* also empties the list */

#endif
