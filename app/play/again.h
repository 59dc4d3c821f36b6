/* The scene that is open, once more: as its file is now, or with other settings. What was changed in the
   window stays: settings, views, camera. */
#ifndef SLOSH_PLAY_AGAIN_H
#define SLOSH_PLAY_AGAIN_H

#include "app/play/model.h"
#include "app/setting/carry.h"
#include "app/setting/differ.h"

/* As its file and the command line have it, as it stands now, and what was changed in between: the settings
   that make the one the other. False: the file's text is none any more, which no caller can mend. */
typedef struct Again {
    Scene filed, now;
    Differ mine; /* setting_list_free its settings */
} Again;
bool again_look(const Model *model, Again *out, Error *error);

/* The text of its file as it was read last; not ended by a 0. */
const char *again_text(const PlayScene *open, size_t *size);

/* Begins it again with these settings too, which go before those of the same key; `particles` more than 0:
   with about so many. A session that is not saved is saved first. False: all stays. */
bool again_open(Model *model, const SettingList *more, size_t particles, Error *error);

/* The scene with its settings as they stand, as a new file in the present folder; says what came of it. */
void again_save(Model *model);

/* The same for a picture: carry_free. */
bool again_carry(const Model *model, Carried *out, Error *error);

typedef enum AgainResult {
    AGAIN_FAILED, /* it cannot be read; all stays */
    AGAIN_LATER,  /* the scene before this one is still ending: ask again in a moment */
    AGAIN_SAME,   /* nothing that counts has changed */
    AGAIN_LIVE,   /* what has changed is in the scene that runs */
    AGAIN_VIEW,   /* the same, and the picture is another one */
    AGAIN_BEGUN   /* it began anew */
} AgainResult;

/* Its file was written, or, with `others`, one that it names. `words` tells what has changed. */
AgainResult again_read(Model *model, bool others, char words[320], Error *error);

#endif
