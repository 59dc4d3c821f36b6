/* Settings "path=value" that nobody else owns: what was found to differ, what a scene is opened with again.
 */
#ifndef SLOSH_SETTING_LIST_H
#define SLOSH_SETTING_LIST_H

#include "app/scene/scene.h"

enum { SETTING_LIST_MAX = 256 };

/* Zero is an empty one. */
typedef struct SettingList {
    int count;
    bool lacks; /* one had no room or no memory */
    char *set[SETTING_LIST_MAX];
} SettingList;

/* Adds one at the end; one of the same path that is there goes. */
void setting_list_add(SettingList *list, const char *setting);

/* The same of a key whose value is that text, whatever letters it has. */
void setting_list_add_text(SettingList *list, const char *path, const char *text);

/* Adds all of `more`, or all of those settings. */
void setting_list_join(SettingList *list, const SettingList *more);
void setting_list_join_scene(SettingList *list, const SceneSettings *settings);

/* Takes out what is of one of the paths of `paths`; lists said whole of which `paths` have an element's key
   ("solids=[{...}]", "solids[0].slip"); keys of elements of lists that `paths` say whole; or what begins with
   that. */
void setting_list_remove(SettingList *list, const SettingList *paths);
void setting_list_remove_around(SettingList *list, const SettingList *paths);
void setting_list_remove_within(SettingList *list, const SettingList *paths);
void setting_list_remove_under(SettingList *list, const char *begin);

/* For as long as the list lives. False: a scene takes no more than SCENE_SETTINGS_MAX of them, or the list
 * lacks some. */
bool setting_list_settings(const SettingList *list, SceneSettings *out, Error *error);

void setting_list_free(SettingList *list); /* empties it */

#endif
