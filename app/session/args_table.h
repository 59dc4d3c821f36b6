/* The tables of commands and options. */
#ifndef SLOSH_ARGS_TABLE_H
#define SLOSH_ARGS_TABLE_H

#include "app/session/args.h"

typedef struct CommandRow {
    Command command;
    const char *name, *usage, *help;
    int scenes_min, scenes_max;
    const char *output; /* required meaning of -o; NULL: -o is not required */
    int width, height;  /* default of --size */
} CommandRow;

typedef enum OptionKind {
    OPTION_FLAG,      /* bool */
    OPTION_TEXT,      /* const char * */
    OPTION_NUMBER,    /* double */
    OPTION_COUNT,     /* int */
    OPTION_SIZE,      /* WxH: width and height */
    OPTION_PARTICLES, /* size_t */
    OPTION_CHOICE,    /* enum or int: `min` plus the index of the name in `value`, "a|b|c" */
    OPTION_SETTING,   /* path=value for the scene: the full text, or the value for the row's `path` */
    OPTION_SWEEP,     /* KEY=a,b,c */
    OPTION_AXIS,      /* KEY=a:b */
    OPTION_DEVICE,    /* const char *: file:PATH */
    OPTION_REFUSED,   /* refused by these commands: `help` gives the reason, after "--device is " */
    OPTION_HELP
} OptionKind;

enum { OPTION_OPEN_LOW = 1 }; /* `min` itself is refused */

typedef struct OptionRow {
    const char *name;  /* "--time", "-o" */
    const char *value; /* name or names of the value; NULL: no value */
    unsigned commands; /* bits 1 << Command */
    OptionKind kind;
    size_t offset;   /* in Args */
    double min, max; /* of a number; min: also of a choice */
    unsigned flags;
    const char *path; /* path of the setting; the option without its dashes is the short name */
    const char *help;
    const char *(*names)(int index); /* possible values, for the help; returns NULL after the last */
} OptionRow;

/* Help topics of `slosh help NAME` besides commands: a table as Markdown, also in docs/, or, if `help` is
   NULL, files for installation for other programs. */
typedef struct HelpTopic {
    const char *name, *help;
    void (*print)(FILE *file);
} HelpTopic;

/* Each table ends with a row without a name. */
extern const CommandRow command_rows[];
extern const OptionRow option_rows[];
extern const HelpTopic help_topics[];

const CommandRow *command_row(Command command);

/* True if the command takes the option, and the command's help lists the option. */
bool option_listed(const OptionRow *option, Command command);

/* Writes the option's help with the possible values. */
enum { OPTION_WORDS_SIZE = 1024 };
void option_words(const CommandRow *row, const OptionRow *option, char *text, size_t size);

#endif
