/* The parsed command line: plain data. What a command is: its name, its options, the files that it reads and
   writes, its function. The parser, the help, the manual page, the completions and the check of files that
   clash read the same rows. */
#ifndef APP_CLI_ARGS_ARGS_H
#define APP_CLI_ARGS_ARGS_H

#include "app/scene/scene.h"
#include "sim/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    ARGS_SCENES_MAX = 64,
    ARGS_SWEEPS_MAX = 8,
    ARGS_LIST_MAX = 5, /* texts of an OPTION_LIST, and the NULL behind them */
    ARGS_SWEEP_VALUES_MAX = 32,
    ARGS_POOL_BYTES = 8192
};

struct CommandFiles;

/* --sweep KEY=a,b,c of bench, --compare KEY=a,b of render. `key` is "particles" or the path of a scene key;
   short names (backend, method, view, threads) become full paths: solver.backend, ... */
typedef struct Sweep {
    const char *key;
    int count;
    const char *values[ARGS_SWEEP_VALUES_MAX];
    const char *typed; /* the key as typed by the user; NULL: same as `key` */
} Sweep;

/* What the commands have in common, and the command's own options. Do not copy: holds pointers into itself
   and into argv. Each member that is not given has the initial value of its option's row, or zero. */
typedef struct Args {
    const struct Command *command; /* NULL: --version */
    void *own;                     /* the command's own options: Command.own_size bytes; freed by args_free */
    uint64_t given;                /* a bit for each row of the command's options */
    bool help;  /* --help: the help of the command is wanted, and nothing else is checked */
    bool quiet; /* no progress and no table */
    int scene_count;
    const char *scenes[ARGS_SCENES_MAX]; /* the arguments: scenes, or what Command.takes says */
    SceneSettings settings;              /* --set, --particles, --backend, --method, --view, --threads */
    const char *json;                    /* FILE, or NULL */
    const char *output;                  /* -o, or NULL */
    const char *shaders;                 /* DIR, or NULL: the built-in shaders */
    const char *device;                  /* "file:PATH", or NULL: the plugged in devices */
    const char *mapping;                 /* FILE, or NULL: the user's mapping file, or the built-in mapping */
    double time;                         /* s, at least 0 */
    int width, height;                   /* pixels, 1 to 16384 */
    int gpu;                             /* number of the EGL device; -1: not given */
    int sweep_count;
    Sweep sweeps[ARGS_SWEEPS_MAX];
    size_t pool_used;
    char pool[ARGS_POOL_BYTES]; /* texts used by settings and sweeps */
} Args;

/* Options. */

typedef enum OptionKind {
    OPTION_FLAG,      /* bool */
    OPTION_TEXT,      /* const char * */
    OPTION_NUMBER,    /* double */
    OPTION_COUNT,     /* int */
    OPTION_SIZE,      /* WxH: two int, width and height */
    OPTION_PARTICLES, /* size_t */
    OPTION_CHOICE,    /* enum or int: `min` plus the index of the name in `value`, "a|b|c" */
    OPTION_SETTING,   /* path=value for the scene: the full text, or the value for the row's `path` */
    OPTION_SWEEP,     /* KEY=a,b,c: a Sweep more */
    OPTION_LIST,      /* const char *[ARGS_LIST_MAX], ends with NULL: a text more */
    OPTION_DEVICE,    /* const char *: file:PATH */
    OPTION_REFUSED,   /* refused by the command: `help` gives the reason, after "--device is " */
    OPTION_HELP
} OptionKind;

enum { OPTION_OPEN_LOW = 1 /* `min` itself is refused */, OPTION_OWN = 2 /* `offset` is in Args.own */ };

typedef struct OptionRow {
    const char *name;  /* "--time", "-o" */
    const char *value; /* name or names of the value; NULL: no value */
    OptionKind kind;
    unsigned flags;
    size_t offset;    /* in Args, or in the command's own options */
    double initial;   /* of a number or a count that is not given */
    double min, max;  /* of a number; min: also of a choice */
    const char *path; /* path of the setting; the option without its dashes is the short name */
    const char *needs,
        *needs_why; /* makes no sense without this option: "--device"; and the sentence for it */
    const char *help;
    const char *(*names)(int index); /* possible values, for the help; returns NULL after the last */
    /* The files that the value names, for the check of clashes (app/cli/cli_private.h); NULL: none. */
    void (*files)(struct CommandFiles *files, const struct OptionRow *row, const char *value);
    const char *pattern; /* for `files`: which files of the folder; NULL: `value` is a file */
} OptionRow;

/* A command owns all that names it: one const struct in its file, and a line in the list of commands. */
typedef struct Command {
    const char *name, *usage, *help;
    const char *takes; /* what an argument is: "scene", "case" */
    int takes_min, takes_max;
    const char *output;       /* required meaning of -o; NULL: -o is not required */
    int width, height;        /* initial values of --size */
    const OptionRow *options; /* ends with a row without a name; at most 64 */
    size_t own_size;          /* bytes of the options that are the command's own; 0: none */
    /* The files that an argument names, and those that the command takes or makes without being told; NULL:
     * none. */
    void (*argument_files)(struct CommandFiles *files, const Args *args, const char *argument);
    void (*unnamed_files)(struct CommandFiles *files, const Args *args);
    int (*run)(const Args *args); /* returns the exit code (app/base/program.h) */
} Command;

/* The commands of a program, ends with NULL. The program's main passes them (app/cli/cli.h), so that no part
   below the commands names one. */
typedef const Command *const *CommandList;

/* Parses main's argv. Without a command, or with a scene in its place, the first command of the list is
   meant. Returns false with "slosh COMMAND: the fault; the remedy": exit code 2. Call args_free in any case.
 */
bool args_parse(CommandList commands, int argc, char *const argv[], Args *args, Error *error);
void args_free(Args *args); /* zeroed is allowed */

/* True if the user has given the option, "--time". */
bool args_given(const Args *args, const char *option);

/* The text of an option of kind TEXT or DEVICE; NULL: not given. */
const char *args_text(const Args *args, const OptionRow *row);

/* Finds a command; returns NULL if there is none. */
const Command *command_find(CommandList commands, const char *name);

/* Sets the error "slosh: unknown command ...", with what may have been meant; returns false. */
bool command_unknown(CommandList commands, const char *name, Error *error);

#endif
