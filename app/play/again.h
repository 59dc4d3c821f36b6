/* Reopens the open scene: with its present file, or with different settings. The window's changes of
   settings, views and camera stay. */
#ifndef SLOSH_PLAY_AGAIN_H
#define SLOSH_PLAY_AGAIN_H

#include "app/files/pictures.h"
#include "app/play/model.h"
#include "app/scene/save.h"

/* The scene of the file and the command line, the present scene, and the settings that turn the first into
   the second. Returns false if the file's text is no longer valid, which callers cannot mend. */
typedef struct Again {
    Scene filed, now;
    SceneDifference mine; /* free with setting_list_free */
} Again;
bool again_look(const Model *model, Again *out, Error *error);

/* The last read text of the scene's file, without a final 0. */
const char *again_text(const PlayScene *open, size_t *size);

/* Restarts the scene with additional settings, which override settings of the same key. `particles` more than
   0: with about so many particles. Saves an unsaved session first. Returns false without changes. */
bool again_open(Model *model, const SettingList *more, size_t particles, Error *error);

/* Saves the scene with its present settings as a new file in the present folder; reports the result. */
void again_save(Model *model);

/* Makes the same text for embedding in a picture; free with embedded_scene_free. */
bool again_carry(const Model *model, EmbeddedScene *out, Error *error);

typedef enum AgainResult {
    AGAIN_FAILED, /* unreadable; no changes */
    AGAIN_LATER,  /* the previous scene is still ending: retry in a moment */
    AGAIN_SAME,   /* no relevant changes */
    AGAIN_LIVE,   /* the running scene has the changes */
    AGAIN_VIEW,   /* like AGAIN_LIVE, with a changed picture */
    AGAIN_BEGUN   /* restarted */
} AgainResult;

/* Call after a write to the scene's file, or with `others` to a file named by the scene. `words` describe the
   changes. */
AgainResult again_read(Model *model, bool others, char words[320], Error *error);

#endif
