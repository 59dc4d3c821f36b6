/* Saves the present scene as a file: the source text with the present settings. */
#ifndef SLOSH_SETTING_SAVE_H
#define SLOSH_SETTING_SAVE_H

#include "app/setting/setting_list.h"

/* A scene to save. */
typedef struct Save {
    const Scene *scene; /* the present scene */
    const char *path;   /* of the source file; files named by the scene are found from its folder */
    const char *text;   /* of the source file */
    size_t size;        /* without a final 0 */
} Save;

/* Result of saving. */
typedef struct Saved {
    char path[1024];
    SettingList changed; /* settings in the text; free with setting_list_free */
    bool lost;           /* comments of a rewritten part were lost */
    char lacks[128];     /* a key whose value could not be kept; "": none */
} Saved;

/* Returns the text, ended by a 0, for a file `output`; the caller frees the text. NULL with the reason. The
   text is read back, and remaining differences are added until there are none. Keys for the count of
   processors are left out. */
char *save_text(const Save *save, const char *output, Saved *out, Error *error);

/* Saves into `output`, which must not exist; or, if NULL, into NAME-2.yaml in the present folder, or
   NAME-3.yaml and so on. */
bool save_scene(const Save *save, const char *output, Saved *out, Error *error);

/* Message such as "dam_break-2.yaml: the scene with fluids[0].viscosity", with missing keys. */
void saved_words(const Saved *saved, char *text, size_t size);

#endif
