/* `--preset NAME`: settings that go together, by fluid and by question, which take the place of the scene's
   own. (`solver.preset` fills in what a scene does not name: app/scene/preset.h.) */
#ifndef SLOSH_RECIPE_H
#define SLOSH_RECIPE_H

#include "app/base/notes.h"
#include "app/yaml/tree.h"

#include <stdio.h>

typedef enum RecipeKind {
    RECIPE_FLUID,   /* what one of the scene's fluids is */
    RECIPE_QUESTION /* what is asked of the solver */
} RecipeKind;

enum { RECIPE_SETTINGS_MAX = 8, RECIPE_DROPS_MAX = 16 };

typedef struct Recipe {
    const char *name;
    RecipeKind kind;
    const char *help;
    const char *source;                   /* of its numbers */
    const char *set[RECIPE_SETTINGS_MAX]; /* "path=value"; "fluid.KEY=..." is of the fluid in question */
    const char *drops[RECIPE_DROPS_MAX];  /* keys that the scene does without, so that its defaults hold */
} Recipe;

/* recipe_rows.c; ended by a NULL name. */
extern const Recipe recipe_list[];

/* Puts "NAME", or "NAME:FLUID" with the name or the number (0, 1, ...) of a fluid, into a tree. Without a
   FLUID it is the first one. Notes get what was changed, and what was left out; NULL is allowed. False with
   "`said`: what is wrong": no such preset, no such fluid. `said` outlives the tree. */
bool recipe_apply(Tree *tree, const char *name, const char *said, Notes *notes, Error *error);

/* Whether the preset "NAME:NUMBER" sets or drops the key of "path=value". */
bool recipe_concerns(const char *name, const char *setting);

/* The list as a table of Markdown. */
void recipe_print(FILE *file);

/* "water|oil|...": for the help; NULL after the last. */
const char *recipe_choice(int index);

#endif
