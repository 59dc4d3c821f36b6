/* The table of all keys of a scene; settings as text, for people and as JSON; terms; presets.

   Two presets are groups of settings. SolverPreset, `solver.preset` of a scene: fills in keys that scene
   and command line leave open. Preset, `--preset NAME` of the command line: replaces settings of the
   scene. */
#ifndef APP_SCENE_KEYS_H
#define APP_SCENE_KEYS_H

#include "app/scene/scene.h"

#include "app/scene/yaml/yaml.h"
#include "sim/base/key.h"

#include <jansson.h>
#include <stdio.h>

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
size_t key_list_at(const Key *list,
                   int index); /* base in a Scene of the offsets of an element's rows, bytes */

/* The owner of a row, its own or of a mapping above; NULL: the key is always read. */
const KeyOwner *key_owner(const Key *key);

/* True if the scene uses the owner. `said`: the command line set the key, for this run only. A file, in
   contrast, serves many runs, and may set up every view and the chart in advance. The window's user may
   change live keys, such as the backend, at any time. */
bool key_owner_used(const KeyOwner *owner, const Scene *scene, bool said);

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

enum { SOLVER_PRESET_SETTINGS_MAX = 20, SOLVER_PRESET_SEVERAL_FLUIDS = 1 };

typedef struct SolverPresetSetting {
    const char *path, *value;
    const char *method; /* the row's only method; NULL: all methods */
    int scenes; /* 2, 3: only scenes of such dimensions; SOLVER_PRESET_SEVERAL_FLUIDS: two or more fluids; 0:
                   all scenes */
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

#endif
