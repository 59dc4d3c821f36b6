#include "app/scene/tables.h"

#include "app/base/path.h"
#include "app/base/picture_text.h"
#include "app/base/read_file.h"
#include "app/scene/check_parts.h"
#include "app/scene/field_file.h"
#include "app/volume/volume_file.h"
#include "app/yaml/yaml.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A table with its source bytes. */
typedef struct Kept {
    struct Kept *next;
    const FieldFileKind *kind;
    char *bytes;
    size_t size;
    FieldTable *table;
} Kept;

/* Not locked: scenes are read on the main thread. */
static Kept *all_kept;

static const Kept *find_kept(const FieldFileKind *kind, const char *bytes, size_t size)
{
    const Kept *kept = all_kept;
    while (kept && (kept->kind != kind || kept->size != size || memcmp(kept->bytes, bytes, size) != 0))
        kept = kept->next;
    return kept;
}

/* Keeps the table; takes ownership of the bytes. */
static const FieldTable *keep(const char *path, char *bytes, size_t size, const FieldFileKind *kind,
                              Error *error)
{
    Kept *kept = malloc(sizeof *kept);
    FieldTable *table = kept ? field_file_parse(path, bytes, size, kind, error) : NULL;
    if (!kept)
        error_set(error, "%.300s: no memory", path);
    if (!table) {
        free(bytes);
        free(kept);
        return NULL;
    }
    *kept = (Kept){all_kept, kind, bytes, size, table};
    all_kept = kept;
    return table;
}

bool scene_names_table(const char *text)
{
    const size_t length = strlen(text);
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

bool scene_beside_path(const char *scene, const char *name, char path[1200], Error *error)
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

bool scene_file_is_there(const char *scene, const char *name, const char *path, Error *error)
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

bool scene_recorded_path(const char *snapshots, const char *folder, const char *name, char path[1200],
                         Error *error)
{
    char found[SCENE_PATH_SIZE], beside[1200];
    Error none;
    if (!scene_beside_path(snapshots, name, beside, error))
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

static const FieldTable *table_of(const Check *check, const char *key, const char *name,
                                  const FieldFileKind *kind)
{
    char path[1200];
    size_t size;
    Error why;
    if (!scene_beside_path(check->tree->path, name, path, &why) ||
        !scene_file_is_there(check->tree->path, name, path, &why)) {
        (void)FAIL(check, key, "%.200s: %s", name, why.message);
        return NULL;
    }
    char *bytes = read_file(path, FIELD_FILE_BYTES_MAX, "table", &size, &why);
    const Kept *kept = bytes ? find_kept(kind, bytes, size) : NULL;
    if (!bytes)
        (void)FAIL(check, key, "%s", why.message);
    if (!kept)
        return bytes ? keep(path, bytes, size, kind, check->error) : NULL;
    free(bytes);
    return kept->table;
}

static bool check_plane(const Check *check, const char *key, const FieldTable *table)
{
    return check->scene->world.dimensions == 3 || (table->count[2] == 1 && !table->value[2]) ||
           FAIL(check, key, "a 2D scene has no z; leave its columns out of the table");
}

static bool read_heights(const Check *check, const char *key, Fill *fill)
{
    if (!scene_names_table(fill->below))
        return true;
    fill->heights = table_of(check, key, fill->below, &field_file_heights);
    return fill->heights && check_plane(check, key, fill->heights);
}

static bool read_velocities(const Check *check, const char *key, FluidDef *fluid)
{
    if (!formula_given(fluid->flow_file))
        return true;
    if (!scene_names_table(fluid->flow_file))
        return FAIL(check, key, "'%s' is no table; name a file that ends in .csv", fluid->flow_file);
    fluid->flow_table = table_of(check, key, fluid->flow_file, &field_file_velocities);
    return fluid->flow_table && check_plane(check, key, fluid->flow_table);
}

bool scene_read_tables(const Tree *tree, Scene *scene, Error *error)
{
    const Check check = {tree, scene, error};
    char key[64];
    for (int f = 0; f < scene->world.fluid_count; f++) {
        FluidDef *fluid = &scene->world.fluids[f];
        snprintf(key, sizeof key, "fluids[%d].velocity_table", f);
        if (!read_velocities(&check, key, fluid))
            return false;
        for (int i = 0; i < fluid->fill_count; i++) {
            snprintf(key, sizeof key, "fluids[%d].fill[%d].below", f, i);
            if (!read_heights(&check, key, &fluid->fills[i]))
                return false;
        }
    }
    return true;
}

/* ---- files named by a scene ---- */

typedef struct Finder {
    const char *scene;
    void (*found)(void *user, const char *what, const char *path);
    void *user;
} Finder;

static void find_in(const Finder *finder, const Node *fluid, const char *key)
{
    const Node *node = fluid->kind == NODE_MAPPING ? node_child(fluid, key) : NULL;
    char path[1200];
    Error none;
    if (node && node->kind == NODE_SCALAR && node->text && scene_names_table(node->text) &&
        scene_beside_path(finder->scene, node->text, path, &none))
        finder->found(finder->user, "table", path);
}

static void find_mesh(const Finder *finder, const Node *shape)
{
    const Node *mesh = shape->kind == NODE_MAPPING ? node_child(shape, "mesh") : NULL;
    const Node *file = mesh && mesh->kind == NODE_MAPPING ? node_child(mesh, "file") : NULL;
    char path[1200];
    Error none;
    if (file && file->kind == NODE_SCALAR && file->text &&
        scene_beside_path(finder->scene, file->text, path, &none))
        finder->found(finder->user, "mesh", path);
}

static void find_all(const Finder *finder, const Node *fluids)
{
    for (const Node *fluid = fluids ? fluids->first : NULL; fluid; fluid = fluid->next) {
        const Node *fills = fluid->kind == NODE_MAPPING ? node_child(fluid, "fill") : NULL;
        find_in(finder, fluid, "velocity_table");
        for (const Node *fill = fills ? fills->first : NULL; fill; fill = fill->next)
            find_in(finder, fill, "below");
        for (const Node *fill = fills ? fills->first : NULL; fill; fill = fill->next)
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
static void find_below(const Finder *finder, const Node *node, int depth)
{
    char path[1200];
    Error none;
    for (const Node *child = node->first; child; child = child->next) {
        const bool names = depth > 1 && node->kind == NODE_MAPPING && strcmp(child->key, "file") == 0;
        if (names && child->kind == NODE_SCALAR && child->text && strcmp(child->text, "none") != 0 &&
            scene_beside_path(finder->scene, child->text, path, &none))
            find_volume(finder, path);
        if (child->kind != NODE_SCALAR)
            find_below(finder, child, depth + 1);
    }
}

static void find_views(const Finder *finder, const Node *views)
{
    if (views && views->kind != NODE_SCALAR)
        find_below(finder, views, 0);
}

void scene_find_tables(const char *path, const char *bytes, size_t size, const SceneSettings *settings,
                       void (*found)(void *user, const char *what, const char *path), void *user)
{
    const Finder finder = {path, found, user};
    Tree tree;
    Error none;
    bool ok = size <= SCENE_BYTES_MAX && tree_read(&tree, path, bytes, size, &none);
    for (int i = 0; ok && settings && i < settings->count; i++)
        ok = tree_set(&tree, settings->set[i], settings->said[i], &none);
    if (ok) {
        find_all(&finder, tree_at(&tree, "fluids"));
        const Node *solids = tree_at(&tree, "solids");
        for (const Node *solid = solids ? solids->first : NULL; solid; solid = solid->next)
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
    FileMoved *moved;
    void *user;
} Mover;

static bool names_file(const Node *node)
{
    return node->text && (scene_names_table(node->text) || (node->key && strcmp(node->key, "file") == 0));
}

/* Finds the full path of a file named in the scene at `scene`. Returns false if there is no such file. */
static bool whole_name(const char *scene, const char *name, char whole[PATH_MAX])
{
    char path[1200];
    Error none;
    struct stat is;
    return scene_beside_path(scene, name, path, &none) && realpath(path, whole) && stat(whole, &is) == 0 &&
           S_ISREG(is.st_mode);
}

static void each_below(Node *node, const char *path, FileNamed *named, void *user)
{
    int place = 0;
    for (Node *child = node->first; child; child = child->next, place++) {
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

void scene_each_file(Tree *tree, FileNamed *named, void *user)
{
    each_below(tree->root, "", named, user);
}

/* A FileNamed. */
static void move_file(void *user, Node *node, const char *path)
{
    const Mover *mover = user;
    char own[PATH_MAX], other[PATH_MAX];
    if (*node->text != '/' && whole_name(mover->from, node->text, own) &&
        !(whole_name(mover->to, node->text, other) && strcmp(own, other) == 0))
        mover->moved(mover->user, node, path, own);
}

void scene_move_files(Tree *tree, const char *output, FileMoved *moved, void *user)
{
    scene_each_file(tree, move_file, &(Mover){tree->path, output, moved, user});
}
