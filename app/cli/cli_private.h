/* What commands share: help, the files of a command line, the kinds of `slosh export`. Messages go to
 * standard error. */
#ifndef APP_CLI_CLI_PRIVATE_H
#define APP_CLI_CLI_PRIVATE_H

#include "app/cli/cli.h"

#include "app/base/program.h"
#include "app/cli/args/args.h"
#include "app/files/snapshot.h"
#include "app/run/compare/compare.h"
#include "app/run/playback/playback.h"
#include "app/scene/scene.h"
#include "render/renderer.h"

#include <stdio.h>

/* Writes the option's help with the possible values. */
enum { OPTION_WORDS_SIZE = 1024 };
void option_words(const Command *command, const OptionRow *option, char *text, size_t size);

/* Help topics of `slosh help NAME` besides commands: a table as Markdown, also in docs/, or, if `help` is
   NULL, files for installation for other programs. The list ends with a row without a name. */
typedef struct HelpTopic {
    const char *name, *help;
    void (*print)(FILE *file);
} HelpTopic;

extern const HelpTopic help_topics[];

/* AUTO: not given; then in the order of --color-by's names. */
typedef enum ColorChoice {
    COLOR_CHOICE_AUTO,
    COLOR_CHOICE_FLUID,
    COLOR_CHOICE_SPEED,
    COLOR_CHOICE_DENSITY,
    COLOR_CHOICE_PRESSURE
} ColorChoice;

/* The options of `slosh export`. */
typedef struct ExportOptions {
    SnapshotFrame frame;         /* frame of positions and velocities */
    bool surface;                /* the fluid's surface instead of the particles */
    bool fluids;                 /* a separate surface for each fluid */
    bool solids;                 /* also the solids */
    double level, cell;          /* of the surface; 0: not given */
    ColorChoice color_by;        /* of a .ply or a .obj */
    const char *slice;           /* "{point: ..., normal: ...}"; NULL: no slice, and no --kernel or --raw */
    const char *trails;          /* "{stride: 20, ...}"; NULL: no trails */
    const char *scalar, *kernel; /* NULL: not given */
    bool raw;
} ExportOptions;

static inline const ExportOptions *options_of_export(const Args *args)
{
    return args->own;
}

/* Shared parts of all kinds of `slosh export`, and the exports of slices and trails. */

/* Opens the snapshots of the command line, at least one; reports a gap at the end. Returns false with the
   reason; close *reader in any case. */
bool export_open(const Args *args, SnapshotReader **reader, Error *error);

/* Chooses the last snapshot, or the first at or after --time. */
bool export_choose(const Args *args, SnapshotReader *reader, size_t *index, Error *error);

/* Finds the scalar of that name; returns false with the list of names. */
bool export_scalar(const char *name, Scalar *scalar, Error *error);

/* True if snapshot `index` has the scalar; otherwise the error lists the scalars. */
bool export_has_scalar(const Args *args, SnapshotReader *reader, size_t index, Scalar scalar, Error *error);

/* Returns false if an option or the output's name needs --slice, which is missing. */
bool export_needs_slice(const Args *args, Error *error);

/* Values of --scalar and --kernel; NULL after the last. */
const char *export_scalar_choice(int index);
const char *export_kernel_choice(int index);

/* Runs --slice; returns the exit code. */
int export_slice(const Args *args);

/* Runs --trails; returns the exit code. */
int export_trails(const Args *args);

/* Files read and written by a command line: no output may be an input or another output. */

typedef struct CommandFiles CommandFiles;
typedef enum FileUse { FILE_READ, FILE_REPLACED, FILE_NEW /* refused if the file exists */ } FileUse;

/* Adds a file, by the word for the user ("--json", "the scene"), or, with a pattern, a folder of such files.
   Ignores NULL and paths that cannot be resolved, which the command reports itself. */
void command_files_add(CommandFiles *files, FileUse use, const char *word, const char *name,
                       const char *pattern);

/* Adds an output: `path` with its last `length` bytes replaced by `ending`. */
void command_files_add_beside(CommandFiles *files, const char *word, const char *path, size_t length,
                              const char *ending, const char *pattern);

/* For OptionRow.files: the value is a file that is read, replaced, made new; "file:PATH"; the file of --json,
   unless it is standard output; a chart, whose figures stand in a .csv. */
void files_read(CommandFiles *files, const OptionRow *row, const char *value);
void files_replaced(CommandFiles *files, const OptionRow *row, const char *value);
void files_new(CommandFiles *files, const OptionRow *row, const char *value);
void files_device(CommandFiles *files, const OptionRow *row, const char *value);
void files_json(CommandFiles *files, const OptionRow *row, const char *value);
void files_chart(CommandFiles *files, const OptionRow *row, const char *value);

/* For Command.argument_files: a scene with its tables and meshes; a recorded session with those of its scene;
   snapshots. */
void files_scene(CommandFiles *files, const Args *args, const char *name);
void files_recording(CommandFiles *files, const Args *args, const char *name);
void files_snapshots(CommandFiles *files, const Args *args, const char *name);

/* Compares the outputs with each other and with the inputs, as the rows of the command have them. Compares by
   file, for any names, and by future path for missing files. Creates nothing. Returns false with both names:
   exit code 2. A file that is only made new may name an input: the command itself reports that the file
   exists. */
bool command_files_check(const Args *args, Error *error);

/* The table of commands and options for other programs: `slosh help man`, `slosh help bash` and `slosh
   help zsh`, installed by tools/package. */

/* Prints the manual page, for man(1). */
void manual_print(FILE *file);

/* Prints shell completions: commands, scenes, options, their values, keys of a scene. */
void completion_print_bash(FILE *file);
void completion_print_zsh(FILE *file);

/* Contents of `slosh render`: the views of a scene; with --compare two or four settings of the scene side
   by side, each with its views in a column. */

typedef struct RenderOptions {
    bool interpolate; /* also a single picture is between two states of a fixed step */
    bool steps;       /* several pictures too show states */
    double fps;       /* more than 0 */
    int frames;       /* at least 1; 0: not given */
} RenderOptions;

static inline const RenderOptions *options_of_render(const Args *args)
{
    return args->own;
}

/* True if pictures are between two states, at even times; false: of the first state at or after.
   A film with pictures at uneven times judders. */
static inline bool render_between(const Args *args, bool several)
{
    const RenderOptions *own = options_of_render(args);
    return own->interpolate || (several && !own->steps);
}

/* Refuses --interpolate with --steps. */
bool render_options_agree(const Args *args, Error *error);

typedef struct RenderPlan {
    const Args *args;
    int setting_count; /* of --compare; 1 without */
    int panel_count, world_count;
    Scene scenes[PANELS_MAX];           /* per setting */
    char names[PANELS_MAX][TITLE_SIZE]; /* per setting: "particles 2000"; "" for a single setting */
    int setting_of[PANELS_MAX];         /* per panel */
    const ViewDef *views[PANELS_MAX];   /* per panel, in the scene of its setting */
    int world_of[PANELS_MAX];    /* per panel; settings differing only in keys of the view share a world;
                                    -1: a file */
    Scene own[PANELS_MAX];       /* for panels whose view has own settings */
    Scene *scene_of[PANELS_MAX]; /* per world: pointer into `scenes` or `own` */
    char worlds[PANELS_MAX][TITLE_SIZE]; /* per world: name of its settings without keys of the view */
    int file_of[PANELS_MAX];             /* per panel; -1: simulated */
    int leader_of[PANELS_MAX]; /* per panel: the world of the setting's scene without view settings; -1:
                                  not shown by any panel */
    int file_count;
    Recorded files[PANELS_MAX]; /* recorded runs; the shoot takes over their readers */
} RenderPlan;

/* Loads all settings and prints notes; starts and writes nothing. Returns false with the reason and the
   faulty setting; call render_plan_close in either case. */
bool render_plan_make(const Args *args, RenderPlan *plan, Error *error);
void render_plan_close(RenderPlan *plan); /* zeroed is allowed */

/* Fills in the panel's name, from the setting and the view's own settings; "": none. */
void render_plan_name(const RenderPlan *plan, int panel, char name[TITLE_SIZE]);

/* Report of `slosh render` at the end. */

typedef struct RenderFigures {
    size_t pictures;
    double step_seconds[PANELS_MAX];     /* wall time of each world's steps */
    bool differ[PANELS_MAX][PANELS_MAX]; /* [a][b], b < a: the panels differed in some picture */
    double apart;                        /* greatest time between the states of a picture, s */
    double late;                         /* greatest delay of a state after the time of its picture, s */
    bool stopped;                        /* by a signal */
} RenderFigures;

/* Reports, after a failure, the count of complete frames in the folder; prints nothing for 0. */
void render_report_kept(const Args *args, size_t frames);

/* Prints the closing lines on standard error; for several panels also which panels were equal in all
   pictures. */
void render_report(const RenderPlan *plan, const Session sessions[], const RenderFigures *figures);

/* Writes --json FILE, if given: for a scene as session_write_json, for several panels as in
   docs/manual/compare.md. */
bool render_write_json(const RenderPlan *plan, const Session sessions[], const PanelPictures *panel_pictures,
                       const RenderFigures *figures, Error *error);

/* `slosh render FILE.h5part`: pictures of a recorded run. Returns the exit code. */
int render_file(const Args *args);

/* `slosh info FILE.h5part`: steps, scalars and assumptions of a file of particles. Returns the exit code. */
int info_file(const Args *args);

/* `slosh render` of a recorded session, which is simulated again. Returns the exit code. */
int render_session(const Args *args);

/* Combinations of swept settings: each value of a sweep with each value of the other sweeps; the last sweep
   varies fastest. */

/* Count of combinations; 1 without sweeps. */
size_t sweeps_combinations(const Sweep sweeps[], int count);

/* The value of sweep number `which` in a combination. */
const char *sweeps_value(const Sweep sweeps[], int count, int which, size_t combination);

/* The key as typed by the user. */
const char *sweep_typed(const Sweep *sweep);

/* "key=value, key=value", keys as typed by the user, `equals` between key and value; "" without sweeps. */
void sweeps_name(const Sweep sweeps[], int count, size_t combination, const char *equals, char *name,
                 size_t size);

enum { SWEEP_SAID = 512 };

/* Adds a value of a sweep to the settings; `said` gets "--sweep key=value", with the option's name, and must
   live as long as the settings. Returns false if there are too many settings. */
bool sweep_set(const char *key, const char *value, const char *option, char said[SWEEP_SAID],
               SceneSettings *settings, Error *error);

#endif
