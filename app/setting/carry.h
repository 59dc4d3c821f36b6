/* The scene that a picture carries: as it stands, and nothing of the machine that it was made on. */
#ifndef SLOSH_SETTING_CARRY_H
#define SLOSH_SETTING_CARRY_H

#include "app/output/image.h"
#include "app/setting/save.h"

/* Owned by whoever made it; ImageText points into it. */
typedef struct Carried {
    char *scene; /* NULL: none */
    char name[128];
} Carried;

/* The scene's text with its settings, and its name without folders. Of files that it names by whole paths the
   names alone are left: such a scene finds them beside the picture. False with the reason, and nothing to
   free: the picture is better without. */
bool carry_make(const Save *save, Carried *out, Error *error);

ImageText carry_text(const Carried *carried, double time);
void carry_free(Carried *carried);

#endif
