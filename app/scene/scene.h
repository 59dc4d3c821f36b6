/* Scenes: a scene file as plain data, its changes at run time, notes for the user, and the files of a scene.
   Further the table of all keys, presets, and the present scene as a file. */
#ifndef APP_SCENE_SCENE_H
#define APP_SCENE_SCENE_H

#include "app/run/measure/measure_def.h"
#include "app/scene/yaml/yaml.h"
#include "render/frame/frame.h"
#include "render/renderer.h"
#include "sim/base/key.h"
#include "sim/def.h"
#include "sim/error.h"
#include "sim/flow/flow.h"

#include <dirent.h>
#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* A scene file, read and checked: plain data; its changes at run time; and notes for the user. */

/* Notes for the user of a scene, which are not errors: settings without effect, changed settings, settings
   that will not hold. One line each, without repeats. */

enum { NOTES_MAX = 24, NOTE_SIZE = 400 };

typedef struct Notes {
    int count;
    int lasting;                     /* count of notes, at the front, that hold for any change at run time */
    char line[NOTES_MAX][NOTE_SIZE]; /* without a newline */
} Notes;

/* Adds a line; repeated lines are skipped, and beyond NOTES_MAX the last line reports that there are more.
   `notes` may be NULL: nothing happens. */
void notes_add(Notes *notes, const char *format, ...) __attribute__((format(printf, 2, 3)));

bool notes_have(const Notes *notes, const char *line);
void notes_print(const Notes *notes, FILE *file);

/* A scene file, read and checked: plain data.

   The file is YAML (DESIGN 8). One table of keys has the place, unit, range and default
   of each key; the loader, `--set`, `info` and the documentation use this table. */

enum { SCENE_METRICS_MAX = 8 };

/* Purpose of reading a scene: some keys apply to some purposes only. */
typedef enum ScenePurpose {
    SCENE_FOR_ONE,    /* a command that does not change method, backend and view */
    SCENE_FOR_WINDOW, /* the window, where backend and view may change */
    SCENE_FOR_CHART
} ScenePurpose;

typedef struct Scene {
    char path[1024]; /* as found; used in messages */
    ScenePurpose purpose;
    bool recorded; /* states come from a file, not from a solver */
    char title[128];
    WorldDef world;
    ViewDef view;
    const char *compared_set;  /* of a compare run: `set` of its entry of `views`; NULL: none */
    int view_count;            /* count of pictures side by side; 0: one, `view` */
    ViewDef views[PANELS_MAX]; /* each is `view` with the changes of its entry */
    char preset[NAME_SIZE];    /* filled in the missing keys */
    unsigned preset_filled;    /* bit k: the preset's setting k was filled in */
    bool realtime; /* the window follows the wall clock; otherwise it simulates as fast as possible */
    int metric_count;
    /* for `slosh chart`: indices into metric_kinds (app/run/measure/measure.h) */
    int metrics[SCENE_METRICS_MAX];
    ProbeList probes; /* unknown to the world */
    TouchDef touch;   /* unknown to the world; the window makes commands of touches */
} Scene;

enum { SCENE_SETTINGS_MAX = 64 };

/* Settings of the command line, applied on top of the file. */
typedef struct SceneSettings {
    int count;
    const char *set[SCENE_SETTINGS_MAX]; /* "path=value", in the given order; also from --backend, --method,
                                            --view, --threads */
    const char
        *said[SCENE_SETTINGS_MAX]; /* name in messages: "--backend cuda"; NULL: --set and the setting */
    const char *compared_set;      /* Scene.compared_set */
    size_t particles;              /* --particles; 0: the scene's own spacing */
    ScenePurpose purpose;
    bool goes_on;  /* a resumed run: the tables of its start may be gone, and are read only for `particles` */
    bool recorded; /* a recorded run, not simulated: its start is unchecked, and only unused settings are
                      reported */
    const char
        *folder; /* of a recorded run: folder of the scene's files if not beside the scene; NULL: unknown */
} SceneSettings;

/* Adds a setting. Returns false if there are too many. */
bool scene_settings_add(SceneSettings *settings, const char *said, const char *set, Error *error);

/* Length of the key of a setting, for replacement by a later setting: up to its '='; of a preset the whole
   text. */
size_t scene_setting_key(const char *setting);

/* Picture number `index` of the pictures side by side, from 0, and their count, at least 1. */
const ViewDef *scene_view(const Scene *scene, int index);
int scene_view_count(const Scene *scene);

/* True if the view shows states of this scene, not of a recorded run or of different settings. */
bool scene_shows(const Scene *scene, const ViewDef *view);

/* True if the view reads accelerations, which a world keeps if WorldDef.acceleration. */
bool scene_view_reads_acceleration(const ViewDef *view);

/* Reads, validates and fills `out`. Returns false on failure: `error` has "file:line:column: the fault; the
   remedy", or "--set path=value: ..." for a wrong command line. Creates nothing. `name` is a path, or the
   name of a file beside the sources of the program (scenes/box_slosh.yaml, box_slosh). `notes` (may be NULL)
   is emptied, then gets lines for the user: that --particles scaled dt, and the lines of scene_advise. */
bool scene_load(const char *name, SceneSettings *settings, Scene *out, Notes *notes, Error *error);

/* Loads the scene from `size` bytes in memory; pure except for the scene's tables;
   for tests and the fuzz target. */
bool scene_parse(const char *path, const char *bytes, size_t size, SceneSettings *settings, Scene *out,
                 Notes *notes, Error *error);

/* Changes a scene while the simulation runs: settings from the panel and from recorded commands. */

/* Sets a key that may change while the simulation runs (KEY_LIVE), in a scene that was
   read and checked: "gravity=[0, -3, 0]", "view.range=auto", "fluids[1].viscosity=0.2". Types, ranges, cross
   checks and messages ("--set path=value: ...") are those of `--set`. The camera's keys need a scene with a
   fixed camera. `concerns_world` (may be NULL) is set to true if a solver reads the key: then call
   world_change. Returns false with the reason: scene and *concerns_world are unchanged. */
bool scene_set_live(Scene *scene, const char *setting, bool *concerns_world, Error *error);

/* A setting as a value, from a widget of the panel to a solver. */
enum { SETTING_BYTES = 176, SETTING_TEXT_SIZE = 192 };

typedef struct SettingValue {
    const Key *key; /* KEY_LIVE, of a type with a widget: no text, table or list of names */
    int element;    /* index in the list around the key; 0 without one */
    union {
        double number[3]; /* also of a curve, a vector, a colour (linear) */
        float single[3];  /* a colour of KEY_SINGLE */
        int whole;        /* also of a choice of KEY_INDEX */
        bool on;
        char name[NAME_SIZE]; /* a choice */
        ControlPoints points;
        struct {
            double ends[2];
            bool automatic[2]; /* also symmetric */
        } range;
        char bytes[SETTING_BYTES];
    };
} SettingValue;

/* The replaced value. */
typedef struct SettingBefore {
    _Alignas(double) char field[SETTING_BYTES];
    TimeTable table;
    bool automatic[2];
} SettingBefore;

/* Sets the value as scene_set_live sets the value's text, with the same refusals in the same words. Checks
   only the value and the rules of the key; prints the text only of a refused value. *before: for
   scene_set_back. */
bool scene_set_value(Scene *scene, const SettingValue *value, SettingBefore *before, bool *concerns_world,
                     Error *error);
void scene_set_back(Scene *scene, const SettingValue *value, const SettingBefore *before);

/* The value's "path=value", from which the same bits are read (a colour has at most nine digits); and the
   path alone. */
void setting_value_text(const SettingValue *value, char text[SETTING_TEXT_SIZE]);
void setting_value_path(const SettingValue *value, char path[SETTING_TEXT_SIZE]);

/* True if this machine can hold so many particles. */
bool scene_fits_memory(double particles);

/* Advice for the user: valid settings of a scene that have no effect or will not hold. */

struct YamlTree; /* app/scene/yaml/yaml.h */

/* Adds a line to `notes` for each such setting of a checked scene. `tree` is the source of the scene, for
   lines that begin with "file:line:column: ". A NULL tree, for keys changed at run time, gives lines that
   begin with the key's path. */
void scene_advise(const struct YamlTree *tree, const Scene *scene, Notes *notes);

/* Adds a line if a key set at run time has no effect. scene_key_works: false if the key at `path` would have
   none with any value. */
void scene_advise_key(const Scene *scene, const char *path, Notes *notes);
bool scene_key_works(const Scene *scene, const char *path);

/* Files of a scene: the scene file itself, found and read, also from a picture; and the files that a
   scene names. */

enum { SCENE_PATH_SIZE = 1024, SCENE_NAMES_MAX = 64, SCENE_BYTES_MAX = 1 << 20 };

/* The scenes of slosh: names without .yaml, in alphabetical order. */
typedef struct SceneNames {
    int count;
    char name[SCENE_NAMES_MAX][48];
} SceneNames;

void scene_path_names(SceneNames *names);

/* For scandir: true if the entry's name is a scene file's. */
int scene_path_is_yaml(const struct dirent *entry);

/* The file of `name`: a path, otherwise a path or a bare name (with or without .yaml) in slosh's own folder.
   Then the user's folder (app/base/program.h), then a bare name in the present folder. Folders come last, as
   outputs have the names of scenes too. If there is no file, returns false with the searched places and the
   nearest scene name. */
bool scene_path_find(const char *name, char path[SCENE_PATH_SIZE], Error *error);

/* The file's bytes, or the scene embedded in a picture; the caller frees the bytes. NULL: a folder,
   unreadable, larger than SCENE_BYTES_MAX, or a file for a different command. */
char *scene_file_read(const char *path, size_t *size, Error *error);

/* The scene embedded in a picture of slosh, in the text of the PNG file. */

/* Keywords of the chunks, all iTXt before the pixels: the scene's YAML, the name of the scene file, the time
   of the picture in s. */
#define PICTURE_SCENE "slosh scene"
#define PICTURE_NAME  "slosh name"
#define PICTURE_TIME  "slosh time"

enum { PICTURE_TEXT_MAX = 1 << 20, PICTURE_FILE_MAX = 256 << 20, PICTURE_NAME_SIZE = 128 };

typedef struct PictureText {
    char *scene;                  /* ended by a 0; the caller frees the text */
    size_t size;                  /* without the 0, at most PICTURE_TEXT_MAX */
    char name[PICTURE_NAME_SIZE]; /* "": none, or not plain ASCII */
    double time;                  /* NaN: not given */
} PictureText;

/* True if the path ends in ".png". */
bool picture_text_name(const char *path);

/* Parses a file in memory up to its pixels, of which only lengths and sums are checked; pure. Returns false
   with "path: ...", and nothing to free, if the file is cut or damaged, has no scene or two, or a too long
   text. The text is not checked: check the scene like any scene file. */
bool picture_text_parse(const char *path, const char *bytes, size_t size, PictureText *out, Error *error);

/* Reads and parses a file. */
bool picture_text_read(const char *path, PictureText *out, Error *error);

/* Files named by a scene: tables of heights and velocities at the start, meshes. */

/* Calls `named` with the node and the key's path of each file name: of a table, or the value of a key
   `file`. */
typedef void SceneFileNamed(void *user, YamlNode *node, const char *path);
void scene_each_file(YamlTree *tree, SceneFileNamed *named, void *user);

/* Path of a file named by a scene: in the scene's folder; if missing there and the scene is a link, in the
   folder of the link's target. For a scene in a picture, also in the search path for scenes. Returns false if
   the path is too long. */
bool scene_relative_path(const char *scene, const char *name, char path[1200], Error *error);

/* Calls `found` with each "table", "mesh" and "volume" of the scene in the bytes after the settings (NULL:
   none), so that callers do not overwrite these files. A volume counts as its header and its raw file. Reads
   headers only; finds nothing in an invalid scene. */
void scene_find_tables(const char *path, const char *bytes, size_t size, const SceneSettings *settings,
                       void (*found)(void *user, const char *what, const char *path), void *user);

/* Tables, meshes and volumes are found from the scene's folder. Calls `moved` for each file that a scene at
   `output` would not find: its node, the path of its key, and the file's full path. */
typedef void SceneFileMoved(void *user, YamlNode *node, const char *path, const char *whole);
void scene_move_files(YamlTree *tree, const char *output, SceneFileMoved *moved, void *user);

/* True if the scene has tables. */
bool scene_has_tables(const Scene *scene);

/* The table of all keys of a scene; settings as text, for people and as JSON; terms; presets.

   Two presets are groups of settings. SolverPreset, `solver.preset` of a scene: fills in keys that scene
   and command line leave open. Preset, `--preset NAME` of the command line: replaces settings of the
   scene. */

/* The rows (sim/base/key.h) of all owners in sequence. The loader, `--set`, `slosh info`, the panel and
   `slosh help keys` use this table. */

const Key *scene_keys(int *count);

/* The row of a path. Indices do not matter: fluids[0].density finds "fluids[].density", views[1].kind the row
   of "view.kind", which elements of `views` share. NULL if unknown. */
const Key *scene_key_find(const char *path);

/* The list with the row as a member of its elements, if the list is outermost: "fluids" for "fluids[].color".
   NULL: none. */
const Key *key_list(const Key *key);

int key_list_count(const Key *list, const Scene *scene);

/* Base in a Scene of the offsets of an element's rows, bytes; not for KEY_POINTER. */
size_t key_list_at(const Key *list, int index);

/* The same for any list: `base` is of the list's own offset. */
const char *key_element(const Key *list, const void *base, int index);

/* The owner of a row, its own or of a mapping above; NULL: the key is always read. */
const KeyOwner *key_owner(const Key *key);

/* Who asks for the use of a key. A file serves many runs, and may set up every view and the chart in advance.
   The command line sets a key for a single run; in the window live keys, such as the backend, may change
   later. AT_PRESENT: no live key changes. */
typedef enum KeyUse { KEY_OF_FILE, KEY_SAID, KEY_AT_PRESENT } KeyUse;

/* True if the scene uses the owner. */
bool key_owner_used(const KeyOwner *owner, const Scene *scene, KeyUse use);

/* The outermost owner of a row and the mappings above that the scene does not use; NULL: all are used. */
const KeyOwner *key_owner_missing(const Key *key, const Scene *scene, KeyUse use);

/* "solver.step.mode: cfl" */
void key_owner_condition(const KeyOwner *owner, char *text, size_t size);

/* "cfl: greatest step" */
void key_help_text(const Key *key, char *text, size_t size);

/* Fills `scene` as an empty scene; fluids and motions get values from their rows' `init`. */
void scene_default(Scene *scene);

/* The table as Markdown: `slosh help keys`. */
void scene_keys_print(FILE *file);

/* Prints "path = value unit" for every setting of the resolved scene. */
void scene_print(const Scene *scene, FILE *file);

/* The output of scene_print as text; the caller frees the text. NULL if memory is short. */
char *scene_print_text(const Scene *scene);

/* Writes the value at `base` + the key's offset as people write it, without its unit; "" if the key holds no
   value. */
void key_value_text(const Key *key, const void *base, char *text, size_t size);

/* The terms of a scene's model that could be switched off. A term is a row of the table of keys with an `off`
   value (sim/base/key.h). */

enum { TERMS_MAX = 24, TERM_SIZE = 64 };

typedef struct SceneTerm {
    const Key *key;
    char path[TERM_SIZE];  /* with indices: "fluids[1].viscosity" */
    char value[TERM_SIZE]; /* the scene's value without unit, cut to fit */
} SceneTerm;

/* Finds the scene's terms: terms of the present solver with a value other than off. Returns their count. A
   row for list elements gives a term per element. At most TERMS_MAX terms are found. */
int scene_terms(const Scene *scene, SceneTerm terms[TERMS_MAX]);

/* {"fluids[0].viscosity": {"value": 0.5, "unit": "Pa s"}, ...}: each line of scene_print. Numbers and lists
   keep their type, other values are text; unitless values have no unit. The caller owns the result; NULL if
   memory is short. */
json_t *scene_json(const Scene *scene);

/* ---- presets ---- */

enum { SOLVER_PRESET_SETTINGS_MAX = 24, SOLVER_PRESET_SEVERAL_FLUIDS = 4 };

typedef struct SolverPresetSetting {
    const char *path, *value;
    const char *method; /* the row's only method; NULL: all methods */
    int scenes; /* 2, 3: only scenes of such dimensions; SOLVER_PRESET_SEVERAL_FLUIDS: two or more fluids; a
                   sum: both; 0: all scenes */
    const char *unless; /* a related key: a scene that names this key does not get the row; or NULL */
} SolverPresetSetting;

typedef struct SolverPreset {
    const char *name, *help;
    SolverPresetSetting
        settings[SOLVER_PRESET_SETTINGS_MAX]; /* ended by a NULL path; a later row overrides an earlier row */
} SolverPreset;

/* Ended by a NULL name; the first is the default. */
extern const SolverPreset solver_preset_list[];

/* True if the key's value came from the scene's preset. */
bool solver_preset_filled(const Scene *scene, const char *path);

/* Prints a line per key of the scene's preset: the value, or the scene's own setting. */
void solver_preset_print(const Scene *scene, FILE *file);

typedef enum PresetKind {
    PRESET_FLUID,   /* properties of a fluid of the scene */
    PRESET_QUESTION /* a question to the solver */
} PresetKind;

enum { PRESET_SETTINGS_MAX = 8, PRESET_DROPS_MAX = 16 };

typedef struct Preset {
    const char *name;
    PresetKind kind;
    const char *help;
    const char *source;                   /* of the numbers */
    const char *set[PRESET_SETTINGS_MAX]; /* "path=value"; "fluid.KEY=..." is for the chosen fluid */
    const char *drops[PRESET_DROPS_MAX];  /* keys removed from the scene, so that defaults apply */
} Preset;

/* Ended by a NULL name. */
extern const Preset preset_list[];

/* True if the preset "NAME:NUMBER" sets or drops the key of "path=value". */
bool preset_sets(const char *name, const char *setting);

/* Prints the list as a Markdown table. */
void preset_print(FILE *file);

/* Name number `index` of "water|oil|...", for the help; NULL after the last. */
const char *preset_name(int index);

/* The present scene as a file: differences of two scenes as settings, and the source text with these
   settings written in. */

/* A list of owned settings "path=value": differences found, or settings for reopening a scene. */

enum { SETTING_LIST_MAX = 256 };

/* Zero: an empty list. */
typedef struct SettingList {
    int count;
    bool lacks; /* a setting was dropped: no room or no memory */
    char *set[SETTING_LIST_MAX];
} SettingList;

/* Adds a setting at the end; removes an earlier setting of the same path. */
void setting_list_add(SettingList *list, const char *setting);

/* Adds a setting with any text as its value. */
void setting_list_add_text(SettingList *list, const char *path, const char *text);

/* Adds all settings of `more` or of `settings`. */
void setting_list_join(SettingList *list, const SettingList *more);
void setting_list_join_scene(SettingList *list, const SceneSettings *settings);

/* Remove settings. remove: of the paths in `paths`. around: whole lists ("solids=[{...}]") if `paths` has a
   key of an element ("solids[0].slip"). within: keys of elements of lists that are whole in `paths`. under:
   settings that begin with `begin`. */
void setting_list_remove(SettingList *list, const SettingList *paths);
void setting_list_remove_around(SettingList *list, const SettingList *paths);
void setting_list_remove_within(SettingList *list, const SettingList *paths);
void setting_list_remove_under(SettingList *list, const char *begin);

/* Points `out` at the settings, valid while the list lives. Returns false if there are more than
   SCENE_SETTINGS_MAX, or if the list lacks some. */
bool setting_list_settings(const SettingList *list, SceneSettings *out, Error *error);

void setting_list_free(SettingList *list); /* also empties the list */

/* Differences of two scenes, as settings: changes in the window, settings for a saved file. */

enum { DIFFERENCE_PATH_SIZE = 128 };

typedef struct SceneDifference {
    SettingList settings; /* turn `before` into `now`; free with setting_list_free */
    bool depth;           /* the scenes differ in dimensions, 2 and 3, which no setting can change */
    bool world;           /* a difference is for a solver */
    bool dead;            /* a difference cannot change while the simulation runs */
} SceneDifference;

/* Compares two scenes that were read. Numbers are written so that reading gives the same bits. A list of a
   different length, or with an element of a different kind, is written whole. If the count of `views`
   differs, each entry is written, after "views=[]" if there are fewer. The contents of files named by a scene
   are not compared. */
void scene_difference(const Scene *before, const Scene *now, SceneDifference *out);

/* Lists the paths for people: "a, b, c and 4 more". */
void setting_list_words(const SettingList *settings, char *text, size_t size);

/* Saves the present scene as a file: the source text with the present settings. */

/* A scene to save. */
typedef struct SceneSource {
    const Scene *scene; /* the present scene */
    const char *path;   /* of the source file; files named by the scene are found from its folder */
    const char *text;   /* of the source file */
    size_t size;        /* without a final 0 */
} SceneSource;

/* Result of saving. */
typedef struct SceneSaved {
    char path[1024];
    SettingList changed; /* settings in the text; free with setting_list_free */
    bool lost;           /* comments of a rewritten part were lost */
    char lacks[128];     /* a key whose value could not be kept; "": none */
} SceneSaved;

/* Returns the text, ended by a 0, for a file `output`; the caller frees the text. NULL with the reason. The
   text is read back, and remaining differences are added until there are none. Keys for the count of
   processors are left out. */
char *scene_save_text(const SceneSource *save, const char *output, SceneSaved *out, Error *error);

/* Saves into `output`, which must not exist; or, if NULL, into NAME-2.yaml in the present folder, or
   NAME-3.yaml and so on. */
bool scene_save(const SceneSource *save, const char *output, SceneSaved *out, Error *error);

/* Message such as "dam_break-2.yaml: the scene with fluids[0].viscosity", with missing keys. */
void scene_saved_words(const SceneSaved *saved, char *text, size_t size);

/* Writes changes made by hand to a running scene into the scene's own definition. */

/* Puts solids where a hand has moved them, with their motions continuing from there. Emitters and drains
   in `closed_gates` (gates of sim/flow/flow.h) are closed at the start. Afterwards no solid counts as moved
   by hand. Returns false with the reason, and a def not for use, if memory is short. */
bool world_def_apply_moves(WorldDef *def, uint64_t closed_gates, Error *error);

#endif
