/* Macros for rows of keys (sim/base/key.h), a line or two per key. Include in such .c files only. The rows of
   an owner are an array ended by KEYS_END:

       #define AT(field) offsetof(BoxDef, field)
       const Key box_keys[] = {
           NUMBER("box.tilt", 0, "degrees", -90, 90, AT(tilt), "about z"),
           KEYS_END,
       };

   After a row's help, further members may follow: .owner = &mine, .fallback = "in words", .flags = I. */
#ifndef SLOSH_KEY_ROWS_H
#define SLOSH_KEY_ROWS_H

#include "sim/base/key.h"

#define KEYS_END                                                                                             \
    {                                                                                                        \
        .path = NULL                                                                                         \
    }
#define PLACE(at)      .offset = (at), .aux = KEY_NOWHERE
#define BOUNDS(lo, hi) .min = (lo), .max = (hi)
#define NOT_STORED     .offset = KEY_NOWHERE, .aux = KEY_NOWHERE

/* Flags of most rows. */
enum { R = KEY_REQUIRED, L = KEY_LIVE, O = KEY_OPEN_LOW, I = KEY_IDLE };

/* Rows by type. */
#define MAPPING(PATH, ...)                                                                                   \
    {                                                                                                        \
        .path = PATH, .type = KEY_MAPPING, .unit = "", NOT_STORED, .help = __VA_ARGS__                       \
    }
#define VARIANT(PATH, AUX, VALUE, HELP)                                                                      \
    {                                                                                                        \
        .path = PATH, .type = KEY_VARIANT, .unit = "", .help = HELP, .offset = KEY_NOWHERE, .aux = AUX,      \
        .variant = VALUE                                                                                     \
    }
#define NUMBER(PATH, FLAGS, UNIT, LO, HI, AT, ...)                                                           \
    {                                                                                                        \
        .path = PATH, .type = KEY_NUMBER, .flags = FLAGS, .unit = UNIT, BOUNDS(LO, HI), PLACE(AT),           \
        .help = __VA_ARGS__                                                                                  \
    }
#define CURVE(PATH, FLAGS, UNIT, LO, HI, AT, TABLE, ...)                                                     \
    {                                                                                                        \
        .path = PATH, .type = KEY_CURVE, .flags = FLAGS, .unit = UNIT, BOUNDS(LO, HI), .offset = AT,         \
        .aux = TABLE, .help = __VA_ARGS__                                                                    \
    }
/* PRESETS: an array of ControlPreset. */
#define POINTS(PATH, FLAGS, LO, HI, PRESETS, AT, ...)                                                        \
    {                                                                                                        \
        .path = PATH, .type = KEY_POINTS, .flags = FLAGS, .unit = "", BOUNDS(LO, HI), .names = PRESETS,      \
        .stride = sizeof *(PRESETS), PLACE(AT), .help = __VA_ARGS__                                          \
    }
#define VEC3(PATH, FLAGS, UNIT, LO, HI, AT, HELP)                                                            \
    {                                                                                                        \
        .path = PATH, .type = KEY_VEC3, .flags = FLAGS, .unit = UNIT, BOUNDS(LO, HI), PLACE(AT),             \
        .help = HELP                                                                                         \
    }
#define AXES(PATH, AT, HELP)                                                                                 \
    {                                                                                                        \
        .path = PATH, .type = KEY_AXES, .unit = "", PLACE(AT), .help = HELP                                  \
    }
#define NAMES_OF(PATH, LO, HI, LIST, AT, COUNT, ...)                                                         \
    {                                                                                                        \
        .path = PATH, .type = KEY_NAMES, .unit = "", BOUNDS(LO, HI), .names = LIST,                          \
        .stride = sizeof *(LIST), .offset = AT, .aux = COUNT, .help = __VA_ARGS__                            \
    }
#define INTEGER(PATH, FLAGS, LO, HI, AT, ...)                                                                \
    {                                                                                                        \
        .path = PATH, .type = KEY_INTEGER, .flags = FLAGS, .unit = "", BOUNDS(LO, HI), PLACE(AT),            \
        .help = __VA_ARGS__                                                                                  \
    }
#define BOOLEAN(PATH, FLAGS, AT, ...)                                                                        \
    {                                                                                                        \
        .path = PATH, .type = KEY_BOOLEAN, .flags = FLAGS, .unit = "", PLACE(AT), .help = __VA_ARGS__        \
    }
#define CHOICE(PATH, FLAGS, CHOICES, AT, ...)                                                                \
    {                                                                                                        \
        .path = PATH, .type = KEY_CHOICE, .flags = FLAGS, .unit = "", .choice = CHOICES, PLACE(AT),          \
        .help = __VA_ARGS__                                                                                  \
    }
/* CHOICE takes a function, CHOICE_OF an array of structs that begin with the name. */
#define CHOICE_OF(PATH, FLAGS, LIST, AT, ...)                                                                \
    {                                                                                                        \
        .path = PATH, .type = KEY_CHOICE, .flags = FLAGS, .unit = "", .names = LIST,                         \
        .stride = sizeof *(LIST), PLACE(AT), .help = __VA_ARGS__                                             \
    }
#define TEXT(PATH, FLAGS, SIZE, AT, FALLBACK, HELP)                                                          \
    {                                                                                                        \
        .path = PATH, .type = KEY_TEXT, .flags = FLAGS, .unit = "", BOUNDS(1, (SIZE)-1), .size = (SIZE),     \
        .fallback = FALLBACK, PLACE(AT), .help = HELP                                                        \
    }
/* A name of a file, or what may be as long. */
#define FILE_TEXT(PATH, FLAGS, AT, FALLBACK, HELP)                                                           \
    TEXT(PATH, KEY_POINTER | (FLAGS), FILE_NAME_SIZE, AT, FALLBACK, HELP)
#define SETTINGS(PATH, FLAGS, SIZE, AT, FALLBACK, HELP)                                                      \
    {                                                                                                        \
        .path = PATH, .type = KEY_SETTINGS, .flags = FLAGS, .unit = "", BOUNDS(1, (SIZE)-1), .size = (SIZE), \
        .fallback = FALLBACK, PLACE(AT), .help = HELP                                                        \
    }
#define COLOR(PATH, FLAGS, AT, FALLBACK, HELP)                                                               \
    {                                                                                                        \
        .path = PATH, .type = KEY_COLOR, .flags = FLAGS, .unit = "", BOUNDS(0, 1), .fallback = FALLBACK,     \
        PLACE(AT), .help = HELP                                                                              \
    }
/* KEY_POINTER among FLAGS: the struct has a pointer to the elements. */
#define LIST(PATH, FLAGS, LO, HI, AT, COUNT, ELEMENT, INIT, HELP)                                            \
    {                                                                                                        \
        .path = PATH, .type = KEY_LIST, .flags = FLAGS, .unit = "", BOUNDS(LO, HI), .offset = AT,            \
        .aux = COUNT, .size = sizeof(ELEMENT), .init = INIT, .help = HELP                                    \
    }

#endif
