/* The one table of the keys that a scene may have (sim/base/key.h): all owners' rows one after another. The
   loader, `--set`, `slosh info`, the panel and `slosh help keys` are made from it. */
#ifndef SLOSH_SCENE_KEYS_H
#define SLOSH_SCENE_KEYS_H

#include "app/scene/scene.h"
#include "sim/base/key.h"

#include <stdio.h>

const Key *scene_keys(int *count);

/* The row of a path; indices do not matter: fluids[0].density finds "fluids[].density", views[1].kind the row
   of "view.kind", which elements of that list have. NULL when unknown. */
const Key *scene_key_find(const char *path);

/* The part of row's path below `parent` when the row stands directly in it ("size" in "box"), else NULL. */
const char *key_name_in(const Key *key, const char *parent);

/* The list in whose elements a row's member stands, where that is no element of another list: "fluids" of
   "fluids[].color". NULL: there is none. */
const Key *key_list(const Key *key);

/* A list whose elements have no rows of their own but the keys of a mapping, of which each begins as a copy.
 */
typedef struct KeyLike {
    const char *list, *mapping;
    size_t at; /* where the mapping's struct stands in a Scene, before the list */
} KeyLike;

/* NULL: elements have rows of their own, or it is no list. */
const KeyLike *key_like(const Key *list);

/* The list of a path such as "views[1].kind", whose elements have the keys of a mapping; NULL: it is no such
   path. */
const Key *key_list_like(const char *path);
int key_list_count(const Key *list, const Scene *scene);
size_t key_list_at(const Key *list,
                   int index); /* what offsets of an element's rows count from in a Scene, bytes */

/* The owner of a row, its own or of a mapping above it; NULL: whatever the scene is, the key is read. */
const KeyOwner *key_owner(const Key *key);

/* Whether the scene uses it. `said`: by the command line, for this run alone, while a file serves many. The
   window's user may change live keys, such as the backend, at any time; and a file may say how every view and
   the chart shall be, for when it comes to that. */
bool key_owner_used(const KeyOwner *owner, const Scene *scene, bool said);

/* "solver.step.mode: cfl" */
void key_owner_need(const KeyOwner *owner, char *text, size_t size);

/* "cfl: greatest step" */
void key_help_text(const Key *key, char *text, size_t size);

/* A scene that says nothing; fluids and motions come from their rows' `init`. */
void scene_default(Scene *scene);

/* The table as Markdown: `slosh help keys`. */
void scene_keys_print(FILE *file);

/* The keys of the picture that name a scalar, each with that of its range, which is of that scalar alone. */
enum { KEY_SCALARS = 3 };
typedef struct KeyScalar {
    const char *by, *range;
} KeyScalar;
extern const KeyScalar key_scalars[KEY_SCALARS];

/* Makes the range of such a key automatic. `base`: the Scene, or what the keys of an element of `views` count
   from (key_list_at). */
void key_range_free(const KeyScalar *scalar, void *base);

/* The name of the scalar that a range is of where the picture names this one: beside `auto` it is the speed,
   as the fluids' own colours have none. */
const char *key_ranged(const char *scalar);

/* The same where `before`, of the same kind, has another scalar. */
void key_range_follow(const KeyScalar *scalar, const void *before, void *base);

/* "path = value unit" for every setting of the scene as it was resolved. */
void scene_print(const Scene *scene, FILE *file);

/* The same as text; the caller frees it. NULL when memory is short. */
char *scene_print_text(const Scene *scene);

/* Value at `base` + the key's offset as people write it, without its unit; "" when the key holds none. */
void key_value_text(const Key *key, const void *base, char *text, size_t size);

#endif
