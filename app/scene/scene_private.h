/* Private to app/scene: the steps of scene_load, and what several of its files share. */
#ifndef APP_SCENE_SCENE_PRIVATE_H
#define APP_SCENE_SCENE_PRIVATE_H

#include "app/scene/scene.h"

#include "app/scene/yaml/yaml.h"
#include "sim/base/key.h"
#include "sim/def.h"

#include <stdio.h>

/* ---- the table of keys: keys.c ---- */

/* The part of the row's path below `parent` if the row is a direct member ("size" in "box"), otherwise
   NULL. */
const char *key_name_in(const Key *key, const char *parent);

/* A list whose elements have the keys of a mapping instead of rows of their own; each element starts as a
   copy of the mapping. */
typedef struct KeyListMapping {
    const char *list, *mapping;
    size_t at; /* offset of the mapping's struct in a Scene, which lies before the list */
} KeyListMapping;

/* NULL: elements have rows of their own, or the key is no list. */
const KeyListMapping *key_list_mapping(const Key *list);

/* The list of a path such as "views[1].kind", whose elements have the keys of a mapping; NULL: other
   paths. */
const Key *key_list_of_mapping(const char *path);

/* Keys of the picture that name a scalar, each with the key of the scalar's range. */
enum { KEY_SCALARS = 3 };
typedef struct KeyScalar {
    const char *by, *range;
} KeyScalar;
extern const KeyScalar key_scalars[KEY_SCALARS];

/* Makes the key's range automatic. `base`: the Scene, or the base of an element of `views` (key_list_at). */
void key_range_reset(const KeyScalar *scalar, void *base);

/* Name of the scalar of the range if the picture names `scalar`: for `auto` the speed, as the fluids' own
   colours have no range. */
const char *key_range_scalar(const char *scalar);

/* Makes the range automatic if `before`, a base of the same kind, has a different scalar. */
void key_range_update(const KeyScalar *scalar, const void *before, void *base);

/* The text in the field of a KEY_TEXT or KEY_SETTINGS; "" for none. */
const char *key_text(const Key *key, const void *field);

/* ---- values that read back as the same bits: keys_print.c ---- */

enum { KEY_EXACT_SIZE = 2 * FILE_NAME_SIZE + 2 }; /* in quotes, with any letter escaped */

/* Like key_value_text, but numbers with all significant digits. `dimensions`: of the scene. */
void key_exact_text(const Key *key, const void *base, int dimensions, char *text, size_t size);

/* True if the struct at `base` has the mapping or the variant. */
bool key_is_present(const Key *key, const char *base);

/* Prints the elements of a list with rows of its own as one value: "[{sphere: {...}}, {...}]". Default values
   of an element are left out. */
void key_exact_list(const Key *list, const void *base, int dimensions, FILE *file);

/* ---- presets: presets.c ---- */

/* Fills the settings of the preset named by `tree` into `scene`, which has its defaults; call before reading
   the tree. An unknown preset changes nothing. */
bool solver_preset_apply(const YamlTree *tree, Scene *scene, Error *error);

/* Applies preset "NAME" or "NAME:FLUID" to a tree; FLUID is the name or the number (0, 1, ...) of a fluid, by
   default the first. `notes` (may be NULL) get the changed and the dropped settings. Returns false with
   "`said`: the fault" for an unknown preset or fluid. `said` must outlive the tree. */
bool preset_apply(YamlTree *tree, const char *name, const char *said, Notes *notes, Error *error);

/* ---- files that the scene names: scene_files.c ---- */

/* Reads the scene's tables into its world, with paths relative to the folder of tree->path; checks that the
   tables fit the dimensions. A table lives as long as the program, as copies of scenes and worlds share the
   table without an owner; files with the same bytes are kept once. Returns false with "file:line: ...". */
bool scene_read_tables(const YamlTree *tree, Scene *scene, Error *error);

/* Reads the scene's meshes, found and kept like tables; NULL notes are allowed. In a recorded run an
   unreadable mesh gets no shape, with a note. */
bool scene_read_meshes(const YamlTree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
                       Error *error);

/* True if the value of a key names a table: it ends in ".csv". */
bool scene_names_table(const char *text);

/* Reads the files, found from the folder of tree->path, and passes them to the views. Returns false with
   "file:line: ..." if a file is unreadable; in a recorded run this gives a note, and the file's part is left
   out. */
bool scene_read_view_files(const YamlTree *tree, const SceneSettings *settings, Scene *scene, Notes *notes,
                           Error *error);

/* ---- spacing and time step: resolution.c ---- */

/* Sets the scene's spacing, and scales a fixed dt, or the max_dt of a method without sound, unless set by
   --set; `notes` gets a line about the change. Returns false if no spacing gives the count. */
bool scene_choose_spacing(const YamlTree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
                          Error *error);

/* Replaces defaults of the sound speed and the substeps that do not fit the scene, and reports the change.
   Values set by the scene, the command line or a preset stay. The spacing must be final. */
void scene_fit_step(const YamlTree *tree, Scene *scene, Notes *notes);

void advise_step(const YamlTree *tree, const Scene *scene, Notes *notes);
void advise_sound(const YamlTree *tree, const Scene *scene, Notes *notes);
void advise_places(const YamlTree *tree, const Scene *scene, Notes *notes);
void advise_borne(const YamlTree *tree, const Scene *scene, Notes *notes);
void advise_cohesion(const YamlTree *tree, const Scene *scene, Notes *notes);

/* ---- advice: advise.c ---- */

/* Adds lines for settings without effect because their owner is not in use: the keys in `tree`, with the
   owners of their rows. Such lines come first in `notes`, and live as long as the scene. */
void scene_advise_unused(const YamlTree *tree, const Scene *scene, Notes *notes);

/* For the checks: adds a line about the setting at `path`, with its place if the tree has the key. */
void advise(const YamlTree *tree, const char *path, Notes *notes, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* ---- cross checks: check.c, check_parts.c ---- */

/* Checks all that needs no particle count: fluids inside the box, unique names, axes with a direction, ...
   The error points at the node of the wrong value. */
bool scene_check(const YamlTree *tree, const Scene *scene, Error *error);

/* True if all rules hold with the first part of the key's path among their keys. */
bool scene_check_key(const Scene *scene, const char *path);

/* Checks that each fluid has particles, and that all fit into the machine's memory. */
bool scene_check_count(const YamlTree *tree, const Scene *scene, Error *error);

/* True if counting the particles at this spacing is fast; otherwise the error has the reason. */
bool scene_check_bounds(const YamlTree *tree, const Scene *scene, double spacing, Error *error);

/* Volume in m3; overlaps count twice. */
double scene_fluid_volume(const Scene *scene);

/* The least thickness of a solid, m. */
double scene_solid_width(const SolidDef *solid, int dimensions);

/* A scene to check. */
typedef struct SceneCheck {
    const YamlTree *tree;
    const Scene *scene;
    Error *error;
} SceneCheck;

/* Reports an error at the node of `path`, or at the nearest existing node. */
#define FAIL(check, path, ...)                                                                               \
    tree_error((check)->tree, tree_nearest((check)->tree, path), (check)->error, __VA_ARGS__)

/* Places and directions in the box. */
char scene_axis_name(int k);
/* In two dimensions vectors must lie in the plane. */
bool scene_check_plane(const SceneCheck *check, const char *path, const double v[3]);
bool scene_check_motion(const SceneCheck *check, const char *list, int m, const Motion *motion);

/* Fluids with fills and emitters; drains; solids; probes. */
bool scene_check_fluid(const SceneCheck *check, int f);
bool scene_check_drain(const SceneCheck *check, int index);
bool scene_check_solid(const SceneCheck *check, int index);
/* Solids must not be thinner than a spacing: fluid on both sides would act as one fluid. */
bool scene_check_widths(const SceneCheck *check);
bool scene_check_probe(const SceneCheck *check, int index);
/* Metrics of probes need probes. */
bool scene_check_metrics(const SceneCheck *check);

/* False, with a question about the scale after the error, for a mesh longer than the box from corner to
   corner or shorter than the spacing. NULL: the first such mesh of the scene. In scene_files.c. */
bool scene_check_scale(const SceneCheck *check, const MeshUse *mesh);

#endif
