/* The commands and their options, each once. */
#ifndef SLOSH_ARGS_TABLE_H
#define SLOSH_ARGS_TABLE_H

#include "app/session/args.h"

typedef struct CommandRow {
    Command command;
    const char *name, *usage, *help;
    int scenes_min, scenes_max;
    const char *output; /* what -o must name; NULL: none needed */
    int width, height;  /* default of --size */
} CommandRow;

typedef enum OptionKind {
    OPTION_FLAG,      /* bool */
    OPTION_TEXT,      /* const char * */
    OPTION_NUMBER,    /* double */
    OPTION_COUNT,     /* int */
    OPTION_SIZE,      /* WxH: width and height */
    OPTION_PARTICLES, /* size_t */
    OPTION_CHOICE,    /* enum or int: `min` and the place of the name in `value`, "a|b|c" */
    OPTION_SETTING,   /* path=value for the scene: all of it, or the value for the row's `path` */
    OPTION_SWEEP,     /* KEY=a,b,c */
    OPTION_AXIS,      /* KEY=a:b */
    OPTION_DEVICE,    /* const char *: file:PATH */
    OPTION_REFUSED,   /* not for these commands: `help` says why, after "--device is " */
    OPTION_HELP
} OptionKind;

enum { OPTION_OPEN_LOW = 1 }; /* the least value itself is refused */

typedef struct OptionRow {
    const char *name;  /* "--time", "-o" */
    const char *value; /* name or names of the value; NULL: takes none */
    unsigned commands; /* bits 1 << Command */
    OptionKind kind;
    size_t offset;   /* in Args */
    double min, max; /* of a number; min: also of a choice */
    unsigned flags;
    const char *path; /* of a setting; short name of it: the option without its dashes */
    const char *help;
    const char *(*names)(int index); /* what the value may be, for the help: NULL after the last */
} OptionRow;

/* What `slosh help NAME` prints besides commands: a table as Markdown, which docs/ holds too, or, without a
   help of its own, what is installed for other programs. */
typedef struct HelpTopic {
    const char *name, *help;
    void (*print)(FILE *file);
} HelpTopic;

/* Each ended by a row without a name. */
extern const CommandRow command_rows[];
extern const OptionRow option_rows[];
extern const HelpTopic help_topics[];

const CommandRow *command_row(Command command);

/* Whether the command takes the option, and its help lists it. */
bool option_listed(const OptionRow *option, Command command);

/* The option's help, with what it may be. */
enum { OPTION_WORDS_SIZE = 1024 };
void option_words(const CommandRow *row, const OptionRow *option, char *text, size_t size);

#endif
