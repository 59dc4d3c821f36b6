/* A key of a scene: a row beside the struct with its value, in the folder of its owner (a method, a
   backend, a view, the box ...). The table of all keys is the sequence of these rows (app/scene/scene.h).
   The loader, `--set`, `slosh info`, the panel, the documentation and the comparison in `run --resume` use
   the table. Macros for rows are in sim/base/key_rows.h. */
#ifndef SIM_BASE_KEY_H
#define SIM_BASE_KEY_H

#include <stdbool.h>
#include <stddef.h>

typedef enum KeyType {
    KEY_MAPPING, /* holds keys */
    KEY_VARIANT, /* a mapping; an element of the list has exactly one such mapping, whose name is the
                    element's kind */
    KEY_LIST,    /* holds elements, with keys under "path[]" */
    KEY_NUMBER,  /* double */
    KEY_INTEGER, /* int */
    KEY_BOOLEAN, /* bool */
    KEY_TEXT,    /* char[NAME_SIZE] or larger, or const char * with KEY_POINTER */
    KEY_CHOICE,  /* a name of a list: char[NAME_SIZE], or an int with KEY_INDEX */
    KEY_VEC3,    /* double[3] */
    KEY_AXES,    /* some of x, y, z: bool[3] */
    KEY_NAMES,   /* some names of a list, each at most once: int[max], their indices, and their count at
                    `aux` */
    KEY_COLOR,   /* sRGB 0..1 in the file, linear in the struct: float[3] or double[3] */
    KEY_CURVE,   /* a number or rows [s, number]: double, and a TimeTable at `aux` */
    KEY_RANGE,   /* "auto", "symmetric" or [low, high]: double[2] and bool[2] */
    KEY_POINTS,  /* rows [x, y], x 0 to 1, or a name of such rows: ControlPoints; `names` are of
                    ControlPreset */
    KEY_SETTINGS /* a mapping of paths of keys, or of mappings of such paths, to values: a text with a line
                    "path=value" per setting */
} KeyType;

enum {
    KEY_REQUIRED = 1, /* no default */
    KEY_LIVE = 2,     /* may change while the simulation runs */
    KEY_OPEN_LOW = 4, /* the least value is excluded */
    KEY_INDEX = 8,    /* choice: stored as index in the list (an enum), not as name */
    KEY_SINGLE = 16,  /* color: stored as float[3] */
    KEY_IDLE = 32,    /* changes no bit of a run; for a mapping: neither do the keys below */
    KEY_REBUILD = 64, /* changing the value requires a new view */
    KEY_WORDS = 128,  /* for a text: a list of words is also allowed, [3, 17]: stored as "3 17" */
    KEY_POINTER =
        256 /* text, settings: stored by text_intern (sim/base/base.h), list: by bytes_keep; NULL: none */
};

/* The only reader of some keys: a method, a mode, a part of the scene. If the owner is not in use, a set
   key has no effect, and the user gets a message. */
typedef struct KeyOwner {
    const char *name; /* begins the help of its keys; NULL: the path is clear */
    /* The owner is in use if the key at path `key` has this value: "solver.method" and a method's name.
       NULL `value`: any name but "none"; for a list, any element. */
    const char *key, *value;
    const char *unless;  /* instead of `value`: any other value than this */
    const char *command; /* instead of a key: the only command that reads the keys, "chart" */
    const char *need;    /* words for the missing part of a scene; NULL: "key: value" */
} KeyOwner;

#define KEY_NOWHERE ((size_t)-1) /* an offset: no field */

typedef struct Key {
    const char *path; /* "box.size", "fluids[].density", "motion[].shake.axis" */
    KeyType type;
    unsigned flags;
    const char *unit; /* "" without */
    double min,
        max; /* of each component; for a text, settings, a list or names: of the length; equal: unbounded */
    size_t offset; /* of the field in the owner's struct or, under "[]", in the innermost list's element */
    size_t aux;    /* offset of associated data: count of a list or of names (int), a variant's kind (int), a
                      range's bool[2] (automatic, then symmetric), a curve's TimeTable, or a mapping's bool,
                      false once the mapping is present */
    size_t size;   /* bytes of a text's or settings' field, or of a list's element; of a text or
                      settings with KEY_POINTER: more than the longest text */
    int variant;   /* value of the kind */
    /* Names of a KEY_CHOICE or KEY_NAMES: an array of structs (or plain pointers) of `stride` bytes that
       begin with the name, ended by a NULL name. For a computed list: a function. */
    const void *names;
    size_t stride;
    const char *(*choice)(int index);       /* NULL after the last */
    void (*init)(void *element, int index); /* list: defaults of a zeroed element with index `index` */
    const char *fallback; /* the default in words if not a constant; NULL: as in the struct's defaults */
    const char *off;  /* for a term of the model: the value in a scene without the term; NULL: no such term */
    const char *zero; /* a word for 0, which a file may have in its place: "auto"; NULL: none */
    const char *help; /* one line */
    const KeyOwner *owner; /* of the key and of keys below; NULL: owner of the mapping above, if any */
} Key;

/* Name at `index` of a row's list; NULL after the last, and for a row without a list. */
const char *key_choice(const Key *key, int index);

/* The allowed values of a key, in words. */

/* "0.001 to 1000", "more than 0, at most 5"; "" when not bounded. */
void key_range_text(const Key *key, char *text, size_t size);

/* The same for the numbers alone, if names are also allowed. */
void key_bounds_text(const Key *key, char *text, size_t size);

#endif
