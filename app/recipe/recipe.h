/* `--preset NAME`: groups of settings, for a fluid or a question, that replace the scene's own settings.
   (`solver.preset` fills in missing keys of a scene: app/scene/preset.h.) */
#ifndef SLOSH_RECIPE_H
#define SLOSH_RECIPE_H

#include "app/base/notes.h"
#include "app/yaml/tree.h"

#include <stdio.h>

typedef enum RecipeKind {
    RECIPE_FLUID,   /* properties of a fluid of the scene */
    RECIPE_QUESTION /* a question to the solver */
} RecipeKind;

enum { RECIPE_SETTINGS_MAX = 8, RECIPE_DROPS_MAX = 16 };

typedef struct Recipe {
    const char *name;
    RecipeKind kind;
    const char *help;
    const char *source;                   /* of the numbers */
    const char *set[RECIPE_SETTINGS_MAX]; /* "path=value"; "fluid.KEY=..." is for the chosen fluid */
    const char *drops[RECIPE_DROPS_MAX];  /* keys removed from the scene, so that defaults apply */
} Recipe;

/* recipe_rows.c; ended by a NULL name. */
extern const Recipe recipe_list[];

/* Applies preset "NAME" or "NAME:FLUID" to a tree; FLUID is the name or the number (0, 1, ...) of a fluid, by
   default the first. `notes` (may be NULL) get the changed and the dropped settings. Returns false with
   "`said`: the fault" for an unknown preset or fluid. `said` must outlive the tree. */
bool recipe_apply(Tree *tree, const char *name, const char *said, Notes *notes, Error *error);

/* True if the preset "NAME:NUMBER" sets or drops the key of "path=value". */
bool recipe_concerns(const char *name, const char *setting);

/* Prints the list as a Markdown table. */
void recipe_print(FILE *file);

/* Name number `index` of "water|oil|...", for the help; NULL after the last. */
const char *recipe_choice(int index);

#endif
