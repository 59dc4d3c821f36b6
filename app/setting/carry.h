/* The scene embedded in a picture: the present scene, without traces of the user's machine. */
#ifndef SLOSH_SETTING_CARRY_H
#define SLOSH_SETTING_CARRY_H

#include "app/output/image.h"
#include "app/setting/save.h"

/* Owned by the caller of carry_make; ImageText points into this struct. */
typedef struct Carried {
    char *scene; /* NULL: none */
    char name[128];
} Carried;

/* Makes the scene's text with its settings, and its name without folders. Whole paths of files are shortened
   to names: such a scene finds the files beside the picture. Returns false with the reason, and nothing to
   free: then the picture should carry no scene. */
bool carry_make(const Save *save, Carried *out, Error *error);

ImageText carry_text(const Carried *carried, double time);
void carry_free(Carried *carried);

#endif
