/* The present scene as a file: differences of two scenes as settings, and the source text with these
   settings written in. */
#ifndef APP_SCENE_SAVE_H
#define APP_SCENE_SAVE_H

#include "app/scene/scene.h"

#include "slosh/def.h"

#include <stdint.h>

/* A list of owned settings "path=value": differences found, or settings for reopening a scene. */

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

/* Differences of two scenes, as settings: changes in the window, settings for a saved file. */

enum { DIFFERENCE_PATH_SIZE = 128 };

typedef struct SceneDifference {
    SettingList settings; /* turn `before` into `now`; free with setting_list_free */
    bool depth;           /* the scenes differ in dimensions, 2 and 3, which no setting can change */
    bool world;           /* a difference is for a solver */
    bool dead;            /* a difference cannot change while the simulation runs */
} SceneDifference;

/* Compares two scenes that were read. Numbers are written so that reading gives the same bits. A list of a
   different length, or with an element of a different kind, is written whole. If the count of `views`
   differs, each entry is written, after "views=[]" if there are fewer. The contents of files named by a scene
   are not compared. */
void scene_difference(const Scene *before, const Scene *now, SceneDifference *out);

/* Lists the paths for people: "a, b, c and 4 more". */
void setting_list_words(const SettingList *settings, char *text, size_t size);

/* Saves the present scene as a file: the source text with the present settings. */

/* A scene to save. */
typedef struct SceneSource {
    const Scene *scene; /* the present scene */
    const char *path;   /* of the source file; files named by the scene are found from its folder */
    const char *text;   /* of the source file */
    size_t size;        /* without a final 0 */
} SceneSource;

/* Result of saving. */
typedef struct SceneSaved {
    char path[1024];
    SettingList changed; /* settings in the text; free with setting_list_free */
    bool lost;           /* comments of a rewritten part were lost */
    char lacks[128];     /* a key whose value could not be kept; "": none */
} SceneSaved;

/* Returns the text, ended by a 0, for a file `output`; the caller frees the text. NULL with the reason. The
   text is read back, and remaining differences are added until there are none. Keys for the count of
   processors are left out. */
char *scene_save_text(const SceneSource *save, const char *output, SceneSaved *out, Error *error);

/* Saves into `output`, which must not exist; or, if NULL, into NAME-2.yaml in the present folder, or
   NAME-3.yaml and so on. */
bool scene_save(const SceneSource *save, const char *output, SceneSaved *out, Error *error);

/* Message such as "dam_break-2.yaml: the scene with fluids[0].viscosity", with missing keys. */
void scene_saved_words(const SceneSaved *saved, char *text, size_t size);

/* Writes changes made by hand to a running scene into the scene's own definition. */

/* Puts solids where a hand has moved them, with their motions continuing from there. Emitters and drains
   in `shut` (gates of sim/flow/flow.h) are closed at the start. Afterwards no solid counts as moved by
   hand. */
void world_def_apply_moves(WorldDef *def, uint64_t shut);

#endif
