/* A key of a scene: a row beside the struct that it fills, in the folder of its owner (a method, a backend, a
   view, the box ...). The one table of all keys is these rows one after another (app/scene/keys.h); the
   loader, `--set`, `slosh info`, the panel, the documentation and what `run --resume` compares follow from
   it. The macros that make rows stand in sim/base/key_rows.h. */
#ifndef SLOSH_KEY_H
#define SLOSH_KEY_H

#include <stdbool.h>
#include <stddef.h>

typedef enum KeyType {
    KEY_MAPPING, /* holds keys */
    KEY_VARIANT, /* a mapping of which its list's element has exactly one: its name is the element's kind */
    KEY_LIST,    /* holds elements, whose keys stand under "path[]" */
    KEY_NUMBER,  /* double */
    KEY_INTEGER, /* int */
    KEY_BOOLEAN, /* bool */
    KEY_TEXT,    /* char[NAME_SIZE] or larger */
    KEY_CHOICE,  /* a name of a list: char[NAME_SIZE], or an int with KEY_INDEX */
    KEY_VEC3,    /* double[3] */
    KEY_AXES,    /* some of x, y, z: bool[3] */
    KEY_NAMES,   /* some names of a list, each once: int[max], their places in it, and their count at `aux` */
    KEY_COLOR,   /* sRGB 0..1 in the file, linear in the struct: float[3] or double[3] */
    KEY_CURVE,   /* a number or rows [s, number]: double, and a TimeTable at `aux` */
    KEY_RANGE,   /* "auto", "symmetric" or [low, high]: double[2] and bool[2] */
    KEY_POINTS,  /* rows [x, y], x 0 to 1, or the name of such: ControlPoints; `names` are of ControlPreset */
    KEY_SETTINGS /* a mapping of paths of keys, or of mappings of such, and their values: a text, in which
                    each setting is a line "path=value" */
} KeyType;

enum {
    KEY_REQUIRED = 1, /* no default */
    KEY_LIVE = 2,     /* may change while the simulation runs */
    KEY_OPEN_LOW = 4, /* the least value itself is out of range */
    KEY_INDEX = 8,    /* choice: stored as its place in the list (an enum), not as its name */
    KEY_SINGLE = 16,  /* color: stored as float[3] */
    KEY_IDLE = 32,    /* changes no bit of a run; of a mapping: nor do the keys below it */
    KEY_REBUILD = 64, /* a view whose key it is must be made anew when the value changes */
    KEY_WORDS = 128   /* of a text: a list of words may stand there too, [3, 17]: stored as "3 17" */
};

/* What reads some of the keys only: a method, a mode, a part of the scene. Where it is not in use such a key
   has no effect, and the user is told so. */
typedef struct KeyOwner {
    const char *name; /* what the help of its keys begins with; NULL: their path says it */
    /* It is in use where the key at this path has this value: "solver.method" and a method's name. A value of
       NULL stands for any name but "none", and of a list for any element. */
    const char *key, *value;
    const char *command; /* instead of a key: the one command that reads its keys, "chart" */
    const char *need;    /* what a scene lacks where the owner is not in use; NULL: "key: value" */
} KeyOwner;

#define KEY_NOWHERE ((size_t)-1) /* an offset: has no field */

typedef struct Key {
    const char *path; /* "box.size", "fluids[].density", "motion[].shake.axis" */
    KeyType type;
    unsigned flags;
    const char *unit; /* "" without */
    double min,
        max; /* of each component; of a text, settings, a list or names: its length; equal: not bounded */
    size_t offset; /* of the field in the owner's struct or, under "[]", in the innermost list's element */
    size_t aux; /* offset of what goes with it: the count of a list or of names (int), a variant's kind (int),
                   a range's bool[2]: automatic, and then symmetric; a curve's TimeTable; a mapping's bool
                   that is false once the mapping is there */
    size_t size; /* of a text's or settings' field, of a list's element: bytes */
    int variant; /* value of the kind */
    /* The names of a KEY_CHOICE or KEY_NAMES: an array of structs (or of pointers alone) that begin with the
       name and are `stride` bytes long, ended by a NULL name; or, for a list that is put together, a
       function. */
    const void *names;
    size_t stride;
    const char *(*choice)(int index); /* NULL after the last */
    void (*init)(void *element,
                 int index); /* list: defaults of an element, which is zeroed; `index`: its place */
    const char
        *fallback;   /* the default in words where it isn't one constant; NULL: as in the struct's defaults */
    const char *off; /* the row is a term of the model: its value in a scene that does without; NULL: none */
    const char *help;      /* one line */
    const KeyOwner *owner; /* of the key and of those below it; NULL: that of the mapping above, if any */
} Key;

/* The name at `index` of a row's list; NULL after the last, and of a row without a list. */
const char *key_choice(const Key *key, int index);

#endif
