#include "app/scene/scene.h"

#include "app/base/file.h"
#include "app/scene/import/import.h"
#include "app/scene/scene_private.h"
#include "app/scene/yaml/yaml.h"
#include "render/frame/view.h"
#include "sim/base/base.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A table with its source bytes. */
typedef struct LoadedTable {
    struct LoadedTable *next;
    const FieldFileKind *kind;
    char *bytes;
    size_t size;
    FieldTable *table;
} LoadedTable;

/* Not locked: scenes are read on the main thread. */
static LoadedTable *all_kept;

static const LoadedTable *find_kept(const FieldFileKind *kind, const char *bytes, size_t size)
{
    const LoadedTable *kept = all_kept;
    while (kept && (kept->kind != kind || kept->size != size || memcmp(kept->bytes, bytes, size) != 0))
        kept = kept->next;
    return kept;
}

/* Keeps the table; takes ownership of the bytes. */
static const FieldTable *keep(const char *path, char *bytes, size_t size, const FieldFileKind *kind,
                              Error *error)
{
    LoadedTable *kept = malloc(sizeof *kept);
    FieldTable *table = kept ? field_file_parse(path, bytes, size, kind, error) : NULL;
    if (!kept)
        error_set(error, "%.300s: no memory", path);
    if (!table) {
        free(bytes);
        free(kept);
        return NULL;
    }
    *kept = (LoadedTable){all_kept, kind, bytes, size, table};
    all_kept = kept;
    return table;
}

bool scene_names_table(const char *text)
{
    const size_t length = strlen(text_or_empty(text));
    return length > 4 && strcmp(text + length - 4, ".csv") == 0;
}

/* Returns false if the path is too long. */
static bool in_folder_of(const char *scene, const char *name, char path[1200])
{
    const char *slash = *name == '/' ? NULL : strrchr(scene, '/');
    const int folder = slash ? (int)(slash - scene) + 1 : 0;
    return snprintf(path, 1200, "%.*s%s", folder, scene, name) < 1200;
}

/* Path beside the target of a linked scene; false: the scene is no link. */
static bool beside_target(const char *scene, const char *name, char path[1200])
{
    char target[PATH_MAX];
    struct stat is;
    return *name != '/' && lstat(scene, &is) == 0 && S_ISLNK(is.st_mode) && realpath(scene, target) &&
           in_folder_of(target, name, path);
}

bool scene_relative_path(const char *scene, const char *name, char path[1200], Error *error)
{
    char found[SCENE_PATH_SIZE], other[1200];
    Error none;
    if (!in_folder_of(scene, name, path))
        return error_set(error, "%.300s: its path is too long", name);
    if (access(path, F_OK) != 0 && beside_target(scene, name, other) && access(other, F_OK) == 0)
        memcpy(path, other, sizeof other);
    if (picture_text_name(scene) && access(path, F_OK) != 0 && scene_path_find(name, found, &none))
        memcpy(path, found, sizeof found);
    return true;
}

/* True if a file exists at `path`, the result of scene_relative_path; else the error lists the places
   searched. */
static bool scene_file_exists(const char *scene, const char *name, const char *path, Error *error)
{
    char other[1200];
    if (access(path, F_OK) == 0)
        return true;
    const char *reason = strerror(errno);
    const bool link = beside_target(scene, name, other);
    return error_set(error, "%s: %.300s%s%.300s; name a file that is there%s", reason, path,
                     link ? ", nor " : "", link ? other : "",
                     *name == '/' ? "" : ", from the scene's folder");
}

static bool is_in(const char *folder, const char *name, char path[1200])
{
    return folder && *name != '/' && snprintf(path, 1200, "%s/%s", folder, name) < 1200 &&
           access(path, R_OK) == 0;
}

static bool lacks(const char *beside, const char *folder, Error *error)
{
    return error_set(
        error,
        "neither at %.200s, beside the snapshots,%s%.200s%s nor where scenes are looked for; put it there",
        beside, folder ? " nor in " : "", folder ? folder : "", folder ? ", where the scene was," : "");
}

/* Path of a file of a recorded run: beside the snapshots, else in the scene's former folder, else in the
   search path for scenes. Returns false if the file is missing; the error names the places searched. */
static bool scene_recorded_path(const char *snapshots, const char *folder, const char *name, char path[1200],
                                Error *error)
{
    char found[SCENE_PATH_SIZE], beside[1200];
    Error none;
    if (!scene_relative_path(snapshots, name, beside, error))
        return false;
    if (access(beside, R_OK) == 0)
        memcpy(path, beside, sizeof beside);
    else if (is_in(folder, name, path))
        return true;
    else if (scene_path_find(name, found, &none))
        memcpy(path, found, sizeof found);
    else
        return lacks(beside, folder, error);
    return true;
}

static const FieldTable *table_of(const SceneCheck *check, const char *key, const char *name,
                                  const FieldFileKind *kind)
{
    char path[1200];
    size_t size;
    Error why;
    if (!scene_relative_path(check->tree->path, name, path, &why) ||
        !scene_file_exists(check->tree->path, name, path, &why)) {
        (void)FAIL(check, key, "%.200s: %s", name, why.message);
        return NULL;
    }
    char *bytes = read_file(path, FIELD_FILE_BYTES_MAX, "table", &size, &why);
    const LoadedTable *kept = bytes ? find_kept(kind, bytes, size) : NULL;
    if (!bytes)
        (void)FAIL(check, key, "%s", why.message);
    if (!kept)
        return bytes ? keep(path, bytes, size, kind, check->error) : NULL;
    free(bytes);
    return kept->table;
}

static bool check_plane(const SceneCheck *check, const char *key, const FieldTable *table)
{
    return check->scene->world.dimensions == 3 || (table->count[2] == 1 && !table->value[2]) ||
           FAIL(check, key, "a 2D scene has no z; leave its columns out of the table");
}

/* Lets `read` fill in each fill of fluid f; "fluids[0].fill[1]" is the path of a fill. */
typedef bool FillReader(const void *user, const char *path, Fill *fill);
static bool each_fill(const SceneCheck *check, WorldDef *world, int f, FillReader *read, const void *user)
{
    FluidDef *fluid = &world->fluids[f];
    const size_t size = (size_t)fluid->fill_count * sizeof *fluid->fills;
    Fill *fills = bytes_copy(fluid->fills, size);
    for (int i = 0; fills && i < fluid->fill_count; i++) {
        char path[64];
        snprintf(path, sizeof path, "fluids[%d].fill[%d]", f, i);
        if (!read(user, path, &fills[i])) {
            free(fills);
            return false;
        }
    }
    fluid->fills = bytes_give(fills, size);
    return fluid->fills || size == 0 || FAIL(check, "fluids", "out of memory for the fills");
}

static bool read_heights(const void *user, const char *path, Fill *fill)
{
    const SceneCheck *check = user;
    char key[96];
    if (!scene_names_table(fill->below))
        return true;
    snprintf(key, sizeof key, "%s.below", path);
    fill->heights = table_of(check, key, fill->below, &field_file_heights);
    return fill->heights && check_plane(check, key, fill->heights);
}

static bool read_velocities(const SceneCheck *check, const char *key, FluidDef *fluid)
{
    if (!formula_given(fluid->flow_file))
        return true;
    if (!scene_names_table(fluid->flow_file))
        return FAIL(check, key, "'%s' is no table; name a file that ends in .csv", fluid->flow_file);
    fluid->flow_table = table_of(check, key, fluid->flow_file, &field_file_velocities);
    return fluid->flow_table && check_plane(check, key, fluid->flow_table);
}

bool scene_read_tables(const YamlTree *tree, Scene *scene, Error *error)
{
    const SceneCheck check = {tree, scene, error};
    char key[64];
    for (int f = 0; f < scene->world.fluid_count; f++) {
        FluidDef *fluid = &scene->world.fluids[f];
        snprintf(key, sizeof key, "fluids[%d].velocity_table", f);
        if (!read_velocities(&check, key, fluid) ||
            !each_fill(&check, &scene->world, f, read_heights, &check))
            return false;
    }
    return true;
}

/* ---- files named by a scene ---- */

typedef struct Finder {
    const char *scene;
    void (*found)(void *user, const char *what, const char *path);
    void *user;
} Finder;

static void find_in(const Finder *finder, const YamlNode *fluid, const char *key)
{
    const YamlNode *node = fluid->kind == NODE_MAPPING ? node_child(fluid, key) : NULL;
    char path[1200];
    Error none;
    if (node && node->kind == NODE_SCALAR && node->text && scene_names_table(node->text) &&
        scene_relative_path(finder->scene, node->text, path, &none))
        finder->found(finder->user, "table", path);
}

static void find_mesh(const Finder *finder, const YamlNode *shape)
{
    const YamlNode *mesh = shape->kind == NODE_MAPPING ? node_child(shape, "mesh") : NULL;
    const YamlNode *file = mesh && mesh->kind == NODE_MAPPING ? node_child(mesh, "file") : NULL;
    char path[1200];
    Error none;
    if (file && file->kind == NODE_SCALAR && file->text &&
        scene_relative_path(finder->scene, file->text, path, &none))
        finder->found(finder->user, "mesh", path);
}

static void find_all(const Finder *finder, const YamlNode *fluids)
{
    for (const YamlNode *fluid = fluids ? fluids->first : NULL; fluid; fluid = fluid->next) {
        const YamlNode *fills = fluid->kind == NODE_MAPPING ? node_child(fluid, "fill") : NULL;
        find_in(finder, fluid, "velocity_table");
        for (const YamlNode *fill = fills ? fills->first : NULL; fill; fill = fill->next)
            find_in(finder, fill, "below");
        for (const YamlNode *fill = fills ? fills->first : NULL; fill; fill = fill->next)
            find_mesh(finder, fill);
    }
}

/* Reports a header and its raw file. */
static void find_volume(const Finder *finder, const char *path)
{
    char raw[VOLUME_PATH_SIZE];
    VolumeHeader header;
    Error none;
    finder->found(finder->user, "volume", path);
    if (!volume_header_load(path, &header, &none))
        return;
    volume_raw_path(path, &header, raw);
    finder->found(finder->user, "volume", raw);
}

/* Finds volume data: keys `file` below a view's own keys. */
static void find_below(const Finder *finder, const YamlNode *node, int depth)
{
    char path[1200];
    Error none;
    for (const YamlNode *child = node->first; child; child = child->next) {
        const bool names = depth > 1 && node->kind == NODE_MAPPING && strcmp(child->key, "file") == 0;
        if (names && child->kind == NODE_SCALAR && child->text && strcmp(child->text, "none") != 0 &&
            scene_relative_path(finder->scene, child->text, path, &none))
            find_volume(finder, path);
        if (child->kind != NODE_SCALAR)
            find_below(finder, child, depth + 1);
    }
}

static void find_views(const Finder *finder, const YamlNode *views)
{
    if (views && views->kind != NODE_SCALAR)
        find_below(finder, views, 0);
}

void scene_find_tables(const char *path, const char *bytes, size_t size, const SceneSettings *settings,
                       void (*found)(void *user, const char *what, const char *path), void *user)
{
    const Finder finder = {path, found, user};
    YamlTree tree;
    Error none;
    bool ok = size <= SCENE_BYTES_MAX && tree_read(&tree, path, bytes, size, &none);
    for (int i = 0; ok && settings && i < settings->count; i++)
        ok = tree_set(&tree, settings->set[i], settings->said[i], &none);
    if (ok) {
        find_all(&finder, tree_at(&tree, "fluids"));
        const YamlNode *solids = tree_at(&tree, "solids");
        for (const YamlNode *solid = solids ? solids->first : NULL; solid; solid = solid->next)
            find_mesh(&finder, solid);
        find_views(&finder, tree_at(&tree, "view"));
        find_views(&finder, tree_at(&tree, "views"));
    }
    if (size <= SCENE_BYTES_MAX)
        tree_free(&tree);
}

bool scene_has_tables(const Scene *scene)
{
    for (int f = 0; f < scene->world.fluid_count; f++) {
        const FluidDef *fluid = &scene->world.fluids[f];
        if (formula_given(fluid->flow_file))
            return true;
        for (int i = 0; i < fluid->fill_count; i++)
            if (scene_names_table(fluid->fills[i].below))
                return true;
    }
    return false;
}

/* ---- moving to another folder ---- */

typedef struct Mover {
    const char *from, *to; /* of the scenes */
    SceneFileMoved *moved;
    void *user;
} Mover;

static bool names_file(const YamlNode *node)
{
    return node->text && (scene_names_table(node->text) || (node->key && strcmp(node->key, "file") == 0));
}

/* Finds the full path of a file named in the scene at `scene`. Returns false if there is no such file. */
static bool whole_name(const char *scene, const char *name, char whole[PATH_MAX])
{
    char path[1200];
    Error none;
    struct stat is;
    return scene_relative_path(scene, name, path, &none) && realpath(path, whole) && stat(whole, &is) == 0 &&
           S_ISREG(is.st_mode);
}

static void each_below(YamlNode *node, const char *path, SceneFileNamed *named, void *user)
{
    int place = 0;
    for (YamlNode *child = node->first; child; child = child->next, place++) {
        char inner[256];
        if (node->kind == NODE_SEQUENCE)
            snprintf(inner, sizeof inner, "%.180s[%d]", path, place);
        else
            snprintf(inner, sizeof inner, "%.180s%s%.60s", path, *path ? "." : "", child->key);
        each_below(child, inner, named, user);
        if (names_file(child))
            named(user, child, inner);
    }
}

void scene_each_file(YamlTree *tree, SceneFileNamed *named, void *user)
{
    each_below(tree->root, "", named, user);
}

/* A SceneFileNamed. */
static void move_file(void *user, YamlNode *node, const char *path)
{
    const Mover *mover = user;
    char own[PATH_MAX], other[PATH_MAX];
    if (*node->text != '/' && whole_name(mover->from, node->text, own) &&
        !(whole_name(mover->to, node->text, other) && strcmp(own, other) == 0))
        mover->moved(mover->user, node, path, own);
}

void scene_move_files(YamlTree *tree, const char *output, SceneFileMoved *moved, void *user)
{
    scene_each_file(tree, move_file, &(Mover){tree->path, output, moved, user});
}

/* Reads the meshes of a scene, and reports their faults. */

typedef struct MeshReader {
    SceneCheck check;
    const SceneSettings *settings;
    Notes *notes;
} MeshReader;

/* The name in lines: of a long path the end. */
static const char *name_of(const MeshUse *mesh)
{
    enum { SHOWN = 90 };
    const size_t length = strlen(mesh->file);
    return mesh->file + (length > SHOWN ? length - SHOWN : 0);
}

/* ---- unit of the file ---- */

static double length_of(const MeshUse *mesh)
{
    const double *half = mesh->shape->half;
    return 2 * mesh->scale * fmax(fmax(half[0], half[1]), half[2]);
}

static double diagonal_of(const WorldDef *world)
{
    const double *size = world->box_size;
    return sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
}

static bool is_odd(const WorldDef *world, const MeshUse *mesh)
{
    return mesh->shape && (length_of(mesh) > diagonal_of(world) || length_of(mesh) < world->spacing);
}

static const MeshUse *first_odd(const WorldDef *world)
{
    for (int f = 0; f < world->fluid_count; f++)
        for (int i = 0; i < world->fluids[f].fill_count; i++)
            if (world->fluids[f].fills[i].kind == FILL_MESH && is_odd(world, &world->fluids[f].fills[i].mesh))
                return &world->fluids[f].fills[i].mesh;
    for (int k = 0; k < world->solid_count; k++)
        if (world->solids[k].kind == SOLID_MESH && is_odd(world, &world->solids[k].mesh))
            return &world->solids[k].mesh;
    return NULL;
}

bool scene_check_scale(const SceneCheck *check, const MeshUse *mesh)
{
    const WorldDef *world = &check->scene->world;
    const MeshUse *odd = !mesh ? first_odd(world) : is_odd(world, mesh) ? mesh : NULL;
    const size_t used = check->error && odd ? strlen(check->error->message) : 0;
    if (used > 0)
        snprintf(
            check->error->message + used, sizeof check->error->message - used,
            ". %s is %.3g m long at its scale of %g; is the scale right (0.001 where its file counts millimetres)?",
            name_of(odd), length_of(odd), odd->scale);
    return false;
}

/* ---- reports ---- */

static void say_size(const MeshReader *reader, const char *key, const MeshUse *mesh)
{
    const double length = length_of(mesh), box = diagonal_of(&reader->check.scene->world);
    if (length > box)
        advise(
            reader->check.tree, key, reader->notes,
            "%s is %.3g m long at its scale of %g, more than the box of %.3g m from corner to corner; is the "
            "scale right (0.001 where its file counts millimetres)?",
            name_of(mesh), length, mesh->scale, box);
}

/* Reports overlapping parts, with the share of the volume. */
static void say_overlap(const MeshReader *reader, const char *key, const char *file, const MeshShape *shape,
                        const MeshState *state)
{
    const double twice = shape->excess.volume / (shape->volume + shape->excess.volume);
    char weighs[80] = "", cuts[80] = "its parts overlap";
    if (twice >= 1e-4)
        snprintf(weighs, sizeof weighs, ", and %.2g %% of it, which several enclose, weighs once",
                 100 * twice);
    else if (state->cutting == 0)
        return;
    if (state->cutting > 0)
        snprintf(cuts, sizeof cuts, "the mesh cuts itself, at %s%zu pair%s of triangles",
                 state->all_looked_at ? "" : "at least ", state->cutting, plural(state->cutting));
    advise(reader->check.tree, key, reader->notes, "%s: %s; what any part encloses is solid%s", file, cuts,
           weighs);
}

/* Reports repaired faults and faults beyond repair. */
static void say_state(const MeshReader *reader, const char *key, const char *file, const MeshShape *shape,
                      const MeshState *state)
{
    const TrianglesState *triangles = &state->triangles;
    if (triangles->inside_out)
        advise(reader->check.tree, key, reader->notes, "%s: the mesh is inside out; its faces are turned",
               file);
    if (triangles->turned > 0)
        advise(reader->check.tree, key, reader->notes,
               "%s: %zu of its parts %s inside out; %s faces are turned", file, triangles->turned,
               triangles->turned == 1 ? "is" : "are", triangles->turned == 1 ? "its" : "their");
    if (triangles->flat > 0)
        advise(reader->check.tree, key, reader->notes,
               "%s: %zu of its triangles ha%s no area and are left out", file, triangles->flat,
               triangles->flat == 1 ? "s" : "ve");
    if (triangles->doubled > 0)
        advise(reader->check.tree, key, reader->notes,
               "%s: %zu of its triangles lie%s on another one with the same corners and %s left out", file,
               triangles->doubled, triangles->doubled == 1 ? "s" : "",
               triangles->doubled == 1 ? "is" : "are");
    if (state->coarse[0])
        advise(reader->check.tree, key, reader->notes, "%s: %s", file, state->coarse);
    say_overlap(reader, key, file, shape, state);
}

static void say_mesh(const MeshReader *reader, const char *key, const MeshUse *mesh, const MeshState *state)
{
    say_state(reader, key, name_of(mesh), mesh->shape, state);
    say_size(reader, key, mesh);
}

static bool find(const MeshReader *reader, const char *file, char path[1200], Error *why)
{
    const char *scene = reader->check.tree->path;
    return reader->settings->recorded
               ? scene_recorded_path(scene, reader->settings->folder, file, path, why)
               : scene_relative_path(scene, file, path, why) && scene_file_exists(scene, file, path, why);
}

static bool read_one(const MeshReader *reader, const char *key, MeshUse *mesh)
{
    const SceneCheck *check = &reader->check;
    char path[1200];
    MeshState state = {.cutting = 0};
    Error why = {""};
    if (check->scene->world.dimensions == 2)
        return FAIL(check, key, "a 2D scene has no meshes; write another shape");
    if (find(reader, mesh->file, path, &why))
        mesh->shape = mesh_file_load(path, &state, &why);
    if (!mesh->shape && !reader->settings->recorded)
        return FAIL(check, key, "%s: %s", name_of(mesh), why.message);
    if (!reader->notes)
        return true;
    if (mesh->shape)
        say_mesh(reader, key, mesh, &state);
    else
        notes_add(reader->notes, "%s: %.200s; it is not drawn", name_of(mesh), why.message);
    return true;
}

static bool read_fill_mesh(const void *user, const char *path, Fill *fill)
{
    char key[96];
    snprintf(key, sizeof key, "%s.mesh.file", path);
    return fill->kind != FILL_MESH || read_one(user, key, &fill->mesh);
}

bool scene_read_meshes(const YamlTree *tree, Scene *scene, const SceneSettings *settings, Notes *notes,
                       Error *error)
{
    const MeshReader reader = {{tree, scene, error}, settings, notes};
    char key[96];
    for (int f = 0; f < scene->world.fluid_count; f++)
        if (!each_fill(&reader.check, &scene->world, f, read_fill_mesh, &reader))
            return false;
    for (int k = 0; k < scene->world.solid_count; k++) {
        SolidDef *solid = &scene->world.solids[k];
        snprintf(key, sizeof key, "solids[%d].mesh.file", k);
        if (solid->kind == SOLID_MESH && !read_one(&reader, key, &solid->mesh))
            return false;
    }
    return true;
}

/* Context of reading a scene. */
typedef struct ViewReading {
    SceneCheck check;
    const SceneSettings *settings;
    Notes *notes;
} ViewReading;

/* Reads one file; `view` is the path of the view's keys. */
static bool read_file_of(const ViewReading *reading, const char *view, const ViewFile *file)
{
    char key[128], path[1200];
    Error why;
    snprintf(key, sizeof key, "%.60s.%.63s", view, file->key);
    if (file->wrong)
        return FAIL(&reading->check, key, "%s", file->wrong);
    const char *scene = reading->check.tree->path;
    const bool recorded = reading->settings->recorded;
    const bool found = recorded
                           ? scene_recorded_path(scene, reading->settings->folder, file->name, path, &why)
                           : scene_relative_path(scene, file->name, path, &why) &&
                                 scene_file_exists(scene, file->name, path, &why);
    *file->data = found ? volume_file_cached(path, &why) : NULL;
    if (!*file->data && recorded)
        notes_add(reading->notes, "%s: %.300s; what is of it is left out", key, why.message);
    return *file->data || recorded || FAIL(&reading->check, key, "%s", why.message);
}

static bool read_view(const ViewReading *reading, const char *view, const ViewDef *def)
{
    const ViewKind *kind;
    for (int i = 0; (kind = view_at(i)); i++) {
        ViewFile files[VIEW_FILES_MAX];
        const int count = kind->files ? kind->files(def, files) : 0;
        for (int k = 0; k < count; k++)
            if (!read_file_of(reading, view, &files[k]))
                return false;
    }
    return true;
}

bool scene_read_view_files(const YamlTree *tree, const SceneSettings *settings, Scene *scene, Notes *notes,
                           Error *error)
{
    const ViewReading reading = {{tree, scene, error}, settings, notes};
    for (int i = 0; i < scene->view_count; i++) {
        char view[32];
        snprintf(view, sizeof view, "views[%d]", i);
        if (!read_view(&reading, view, &scene->views[i]))
            return false;
    }
    return read_view(&reading, "view", &scene->view);
}
