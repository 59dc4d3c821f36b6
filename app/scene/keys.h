/* The one table of the keys that a scene may have. The loader, `--set`, `slosh info`, the panel and the table
   of scenes/README.md are made from it. */
#ifndef SLOSH_SCENE_KEYS_H
#define SLOSH_SCENE_KEYS_H

#include "app/scene/scene.h"

#include <stdio.h>

typedef enum KeyType {
    KEY_MAPPING, /* holds keys */
    KEY_VARIANT, /* a mapping of which its list's element has exactly one: its name is the element's kind */
    KEY_LIST,    /* holds elements, whose keys stand under "path[]" */
    KEY_NUMBER,  /* double */
    KEY_INTEGER, /* int */
    KEY_BOOLEAN, /* bool */
    KEY_TEXT,    /* char[NAME_SIZE] or larger */
    KEY_CHOICE,  /* a name of a list */
    KEY_VEC3,    /* double[3] */
    KEY_AXES,    /* some of x, y, z: bool[3] */
    KEY_NAMES,   /* some names of a list, each once: int[max], their places in it, and their count at `aux` */
    KEY_COLOR,   /* sRGB 0..1 in the file, linear in the Scene: float[3] or double[3] */
    KEY_CURVE,   /* a number or rows [s, number]: double, and a TimeTable at `aux` */
    KEY_RANGE    /* "auto" or [low, high]: double[2] and a bool */
} KeyType;

enum {
    KEY_REQUIRED = 1, /* no default */
    KEY_LIVE = 2,     /* may change while the simulation runs */
    KEY_OPEN_LOW = 4, /* the least value itself is out of range */
    KEY_INDEX = 8,    /* choice: stored as its place in the list (an enum), not as its name */
    KEY_SINGLE = 16   /* color: stored as float[3] */
};

/* What reads some of the keys only: a method, a mode, a part of the scene. Where it is not in use such a key
   has no effect, which scene_advise_unused says. */
typedef struct KeyOwner {
    const char *name; /* what the help of its keys begins with; NULL: their path says it */
    const char *need; /* what a scene lacks where the owner is not in use: "solver.method: wcsph" */
    /* Whether it is in use; `said`: by the command line, for this run alone, while a file serves many. */
    bool (*used)(const Scene *scene, bool said);
} KeyOwner;

#define KEY_NOWHERE ((size_t)-1) /* an offset: has no field */

typedef struct Key {
    const char *path; /* "box.size", "fluids[].density", "motion[].shake.axis" */
    KeyType type;
    unsigned flags;
    const char *unit; /* "" without */
    double min, max;  /* of each component; of a text, a list or names: its length; equal: not bounded */
    size_t offset;    /* of the field in the Scene or, under "[]", in the innermost list's element */
    size_t aux; /* offset of what goes with it: the count of a list or of names (int), a variant's kind (int),
                   a range's "auto" (bool); a curve's TimeTable; a mapping's bool that is false once the
                   mapping is there */
    size_t size;                            /* of a text's field, of a list's element: bytes */
    int variant;                            /* value of the kind */
    const char *(*choice)(int index);       /* names of a KEY_CHOICE or KEY_NAMES, NULL after the last */
    void (*init)(void *element, int index); /* list: defaults of an element */
    const char *fallback;  /* the default in words where it isn't one constant; NULL: as in scene_default() */
    const char *help;      /* one line */
    const KeyOwner *owner; /* of the key and of those below it; NULL: that of the mapping above, if any */
} Key;

const Key *scene_keys(int *count);

/* The row of a path; indices do not matter: fluids[0].density finds "fluids[].density". NULL when unknown. */
const Key *scene_key_find(const char *path);

/* The part of row's path below `parent` when the row stands directly in it ("size" in "box"), else NULL. */
const char *key_name_in(const Key *key, const char *parent);

/* The owner of a row, its own or of a mapping above it; NULL: whatever the scene is, the key is read. */
const KeyOwner *key_owner(const Key *key);

/* "wcsph: its kernel" */
void key_help_text(const Key *key, char *text, size_t size);

/* A scene that says nothing; fluids and motions come from their rows' `init`. */
void scene_default(Scene *scene);

double srgb_to_linear(double value);
double linear_to_srgb(double value);

/* The table as Markdown, for scenes/README.md. */
void scene_keys_print(FILE *file);

/* "path = value unit" for every setting of the scene as it was resolved. */
void scene_print(const Scene *scene, FILE *file);

/* The same as text; the caller frees it. NULL when memory is short. */
char *scene_print_text(const Scene *scene);

/* Value at `base` + the key's offset as people write it, without its unit; "" when the key holds none. */
void key_value_text(const Key *key, const void *base, char *text, size_t size);

/* "0.001 to 1000", "more than 0, at most 5"; "" when not bounded. */
void key_range_text(const Key *key, char *text, size_t size);

#endif
