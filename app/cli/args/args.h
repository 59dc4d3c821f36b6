/* The parsed command line: plain data. One table of commands and options (app/cli/args/args.h) serves
   the parser and the help. */
#ifndef APP_CLI_ARGS_ARGS_H
#define APP_CLI_ARGS_ARGS_H

#include "app/files/snapshot.h"
#include "app/scene/scene.h"
#include "slosh/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum {
    ARGS_SCENES_MAX = 64,
    ARGS_SWEEPS_MAX = 8,
    ARGS_AXES_MAX = 4,
    ARGS_SWEEP_VALUES_MAX = 32,
    ARGS_POOL_BYTES = 8192
};

typedef enum Command {
    COMMAND_HELP, /* also --help: help on `help_for`, or on the program if `help_for` is COMMAND_HELP */
    COMMAND_VERSION,
    COMMAND_PLAY, /* also without a command */
    COMMAND_RENDER,
    COMMAND_RUN,
    COMMAND_BENCH,
    COMMAND_VALIDATE, /* `scenes` holds the cases */
    COMMAND_CHART,    /* `scenes` holds a scene or a case */
    COMMAND_STABILITY,
    COMMAND_FIT,    /* `scenes` holds a scene or a case */
    COMMAND_REPLAY, /* `scenes` holds the recording */
    COMMAND_EXPORT, /* `scenes` holds the snapshots */
    COMMAND_DEVICES,
    COMMAND_SCENES, /* `scenes` holds the folder */
    COMMAND_NEW,    /* `scenes` holds the file to write */
    COMMAND_INFO,
    COMMAND_COUNT
} Command;

/* AUTO: not given; then in the order of --clock's names. */
typedef enum ClockChoice { CLOCK_CHOICE_AUTO, CLOCK_CHOICE_GL, CLOCK_CHOICE_FINISH } ClockChoice;

/* AUTO: not given; then in the order of --color-by's names. */
typedef enum ColorChoice {
    COLOR_CHOICE_AUTO,
    COLOR_CHOICE_FLUID,
    COLOR_CHOICE_SPEED,
    COLOR_CHOICE_DENSITY,
    COLOR_CHOICE_PRESSURE
} ColorChoice;

/* --sweep KEY=a,b,c of bench, --compare KEY=a,b of render. `key` is "particles" or the path of a scene key;
   short names (backend, method, view, threads) become full paths: solver.backend, ... */
typedef struct Sweep {
    const char *key;
    int count;
    const char *values[ARGS_SWEEP_VALUES_MAX];
    const char *typed; /* the key as typed by the user; NULL: same as `key` */
} Sweep;

/* Do not copy: holds pointers into itself and into argv. */
typedef struct Args {
    Command command, help_for;
    const struct CommandRow *row;       /* of the command as typed; NULL: --version */
    const struct HelpTopic *help_topic; /* topic of `slosh help TOPIC`; NULL: help on `help_for` */
    int scene_count;
    const char *scenes[ARGS_SCENES_MAX];
    SceneSettings settings; /* --set, --particles, --backend, --method, --view, --threads */
    bool quiet;             /* no progress and no table */
    const char *json;       /* FILE, or NULL */
    const char *save;       /* info: FILE, or NULL */
    const char *output;     /* -o, or NULL */
    const char *forces;     /* run: FILE, or NULL */
    const char *probes;     /* run: FILE, or NULL */
    const char *shaders;    /* DIR, or NULL: the built-in shaders */
    bool time_given;
    double time;      /* s, at least 0; default 5 */
    bool interpolate; /* render: pictures between two states of a fixed step */
    bool resume;      /* run: continue after the last snapshot of the output */
    double every;     /* s, more than 0; default 1/30 */
    double fps;       /* more than 0; default 30 */
    int frames;       /* at least 1; 0: not given */
    bool size_given;
    int width, height; /* pixels, 1 to 16384; default 1280 x 720, of bench 512 x 512 */
    int gpu;           /* number of the EGL device; -1: not given */
    ClockChoice clock;
    SnapshotFrame frame;    /* export: frame of positions and velocities */
    bool surface;           /* export: the fluid's surface instead of the particles */
    bool fluids;            /* export: a separate surface for each fluid */
    bool solids;            /* export: also the solids */
    double level, cell;     /* of the surface; 0: not given */
    ColorChoice color_by;   /* export: of a .ply or a .obj */
    double error, frame_ms; /* fit: percent, ms; 0: not given */
    const char *slice;  /* export: "{point: ..., normal: ...}"; NULL: no slice, and no --kernel or --raw */
    const char *trails; /* export: "{stride: 20, ...}"; NULL: no trails */
    const char *scalar, *kernel; /* NULL: not given */
    bool raw;
    bool full, coarse; /* validate: finer or coarser than the default set */
    const char *table; /* bench: NAME, or NULL */
    bool play;         /* bench: the live window */
    bool micro;        /* bench: each pass alone */
    bool views;        /* chart: pictures instead of runs */
    bool ablate;       /* bench: the scene without each of its terms in turn */
    bool seconds_given;
    double seconds;     /* of --play or --micro; more than 0; default 20 */
    const char *record; /* FILE, or NULL; of devices: raw reports */
    double past;        /* MiB of states for going back in time; default 256 */
    bool past_given;
    const char *device;        /* "file:PATH", or NULL: the plugged in devices */
    bool watch;                /* devices: live values */
    const char *mapping;       /* FILE, or NULL: the user's mapping file, or the built-in mapping */
    const char *write_mapping; /* devices: FILE, or NULL */
    int sweep_count;
    Sweep sweeps[ARGS_SWEEPS_MAX];
    int axis_count;
    const char *axes[ARGS_AXES_MAX]; /* stability: "KEY=a:b" */
    size_t pool_used;
    char pool[ARGS_POOL_BYTES]; /* texts used by settings and sweeps */
} Args;

/* The tables of commands and options. */

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

/* The commands, options and topics of a program; each list ends with a row without a name. The program's main
   passes the table (app/cli/cli.h), so that no part below the commands names one. */
typedef struct ArgsTable {
    const CommandRow *commands;
    const OptionRow *options;
    const HelpTopic *topics;
} ArgsTable;

/* Parses main's argv by the table. Returns false with "slosh COMMAND: the fault; the remedy": exit code 2. */
bool args_parse(const ArgsTable *table, int argc, char *const argv[], Args *args, Error *error);

#endif
