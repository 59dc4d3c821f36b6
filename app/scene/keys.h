/* The table of all keys of a scene (sim/base/key.h): the rows of all owners in sequence. The loader, `--set`,
   `slosh info`, the panel and `slosh help keys` use this table. */
#ifndef SLOSH_SCENE_KEYS_H
#define SLOSH_SCENE_KEYS_H

#include "app/scene/scene.h"
#include "sim/base/key.h"

#include <stdio.h>

const Key *scene_keys(int *count);

/* The row of a path. Indices do not matter: fluids[0].density finds "fluids[].density", views[1].kind the row
   of "view.kind", which elements of `views` share. NULL if unknown. */
const Key *scene_key_find(const char *path);

/* The part of the row's path below `parent` if the row is a direct member ("size" in "box"), otherwise
   NULL. */
const char *key_name_in(const Key *key, const char *parent);

/* The list with the row as a member of its elements, if the list is outermost: "fluids" for "fluids[].color".
   NULL: none. */
const Key *key_list(const Key *key);

/* A list whose elements have the keys of a mapping instead of rows of their own; each element starts as a
   copy of the mapping. */
typedef struct KeyLike {
    const char *list, *mapping;
    size_t at; /* offset of the mapping's struct in a Scene, which lies before the list */
} KeyLike;

/* NULL: elements have rows of their own, or the key is no list. */
const KeyLike *key_like(const Key *list);

/* The list of a path such as "views[1].kind", whose elements have the keys of a mapping; NULL: other
   paths. */
const Key *key_list_like(const char *path);
int key_list_count(const Key *list, const Scene *scene);
size_t key_list_at(const Key *list,
                   int index); /* base in a Scene of the offsets of an element's rows, bytes */

/* The owner of a row, its own or of a mapping above; NULL: the key is always read. */
const KeyOwner *key_owner(const Key *key);

/* True if the scene uses the owner. `said`: the command line set the key, for this run only. A file, in
   contrast, serves many runs, and may set up every view and the chart in advance. The window's user may
   change live keys, such as the backend, at any time. */
bool key_owner_used(const KeyOwner *owner, const Scene *scene, bool said);

/* "solver.step.mode: cfl" */
void key_owner_need(const KeyOwner *owner, char *text, size_t size);

/* "cfl: greatest step" */
void key_help_text(const Key *key, char *text, size_t size);

/* Fills `scene` as an empty scene; fluids and motions get values from their rows' `init`. */
void scene_default(Scene *scene);

/* The table as Markdown: `slosh help keys`. */
void scene_keys_print(FILE *file);

/* Keys of the picture that name a scalar, each with the key of the scalar's range. */
enum { KEY_SCALARS = 3 };
typedef struct KeyScalar {
    const char *by, *range;
} KeyScalar;
extern const KeyScalar key_scalars[KEY_SCALARS];

/* Makes the key's range automatic. `base`: the Scene, or the base of an element of `views` (key_list_at). */
void key_range_free(const KeyScalar *scalar, void *base);

/* Name of the scalar of the range if the picture names `scalar`: for `auto` the speed, as the fluids' own
   colours have no range. */
const char *key_ranged(const char *scalar);

/* Makes the range automatic if `before`, a base of the same kind, has a different scalar. */
void key_range_follow(const KeyScalar *scalar, const void *before, void *base);

/* Prints "path = value unit" for every setting of the resolved scene. */
void scene_print(const Scene *scene, FILE *file);

/* The output of scene_print as text; the caller frees the text. NULL if memory is short. */
char *scene_print_text(const Scene *scene);

/* Writes the value at `base` + the key's offset as people write it, without its unit; "" if the key holds no
   value. */
void key_value_text(const Key *key, const void *base, char *text, size_t size);

#endif
