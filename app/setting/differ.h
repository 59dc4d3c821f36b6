/* Differences of two scenes, as settings: changes in the window, settings for a saved file. */
#ifndef SLOSH_DIFFER_H
#define SLOSH_DIFFER_H

#include "app/setting/setting_list.h"

enum { DIFFER_PATH_SIZE = 128 };

typedef struct Differ {
    SettingList settings; /* turn `before` into `now`; free with setting_list_free */
    bool depth;           /* the scenes differ in dimensions, 2 and 3, which no setting can change */
    bool world;           /* a difference is for a solver */
    bool dead;            /* a difference cannot change while the simulation runs */
} Differ;

/* Compares two scenes that were read. Numbers are written so that reading gives the same bits. A list of a
   different length, or with an element of a different kind, is written whole. If the count of `views`
   differs, each entry is written, after "views=[]" if there are fewer. The contents of files named by a scene
   are not compared. */
void scene_differ(const Scene *before, const Scene *now, Differ *out);

/* Lists the paths for people: "a, b, c and 4 more". */
void differ_words(const SettingList *settings, char *text, size_t size);

#endif
