/* A scene as it stands now, as a file: the text that it came from with the settings in it. */
#ifndef SLOSH_SETTING_SAVE_H
#define SLOSH_SETTING_SAVE_H

#include "app/setting/setting_list.h"

/* What is to be saved. */
typedef struct Save {
    const Scene *scene; /* as it stands */
    const char *path;   /* of the file that it came from: from its folder the files that it names are found */
    const char *text;   /* of that, */
    size_t size;        /* not ended by a 0 */
} Save;

/* What came of it. */
typedef struct Saved {
    char path[1024];
    SettingList changed; /* in the text; setting_list_free */
    bool lost;           /* comments of a part that was written anew */
    char lacks[128];     /* a key that could not be kept as it is; "": all are */
} Saved;

/* The text, ended by a 0, which the caller frees, as it would stand in a file `output`; NULL with the reason.
   It is read again, and what differs then is added, until nothing does. Keys that change nothing but how many
   processors compute are left out. */
char *save_text(const Save *save, const char *output, Saved *out, Error *error);

/* Into `output`, where nothing must be; or, where that is NULL, into NAME-2.yaml of the present folder, or
 * NAME-3.yaml and so on. */
bool save_scene(const Save *save, const char *output, Saved *out, Error *error);

/* "dam_break-2.yaml: the scene with fluids[0].viscosity", and what is lacking. */
void saved_words(const Saved *saved, char *text, size_t size);

#endif
