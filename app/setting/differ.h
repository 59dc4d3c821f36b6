/* In what two scenes differ, as settings: what was changed in the window, what a file that was saved says
 * anew. */
#ifndef SLOSH_DIFFER_H
#define SLOSH_DIFFER_H

#include "app/setting/setting_list.h"

enum { DIFFER_PATH_SIZE = 128 };

typedef struct Differ {
    SettingList settings; /* by which `before` becomes `now`; setting_list_free */
    bool depth;           /* the one has two dimensions and the other three, which no setting says */
    bool world;           /* some of it is for a solver */
    bool dead;            /* some cannot change while the simulation runs */
} Differ;

/* Both are scenes that were read. Numbers are written so that they are read as the same bits. A list of
   another length, or with an element of another kind, is said whole. Of `views` that are more or less each
   entry is said, after "views=[]" where there are less. The bytes of files that a scene names are not looked
   at. */
void scene_differ(const Scene *before, const Scene *now, Differ *out);

/* "a, b, c and 4 more": the paths, for people. */
void differ_words(const SettingList *settings, char *text, size_t size);

#endif
