/* Loads a scene: the file, the command line, the checks and derived values. */
#include "app/scene/scene.h"

#include "app/base/path.h"
#include "app/recipe/recipe.h"
#include "app/scene/advise.h"
#include "app/scene/check.h"
#include "app/scene/keys.h"
#include "app/scene/particles.h"
#include "app/scene/read.h"
#include "app/scene/tables.h"
#include "app/scene/view_files.h"
#include "app/yaml/yaml.h"
#include "render/renderer.h"
#include "sim/matter/fill_lattice.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Default title: the file's name without folder and ending. */
static void title_default(Scene *scene)
{
    if (*scene->title)
        return;
    const char *slash = strrchr(scene->path, '/');
    snprintf(scene->title, sizeof scene->title, "%.100s", slash ? slash + 1 : scene->path);
    char *dot = strrchr(scene->title, '.');
    if (dot && dot != scene->title)
        *dot = 0;
}

typedef char ScalarNames[KEY_SCALARS][NAME_SIZE];

/* The file's scalars, or "" for unset ones. */
static void file_scalars(const Tree *tree, ScalarNames names)
{
    for (int k = 0; k < KEY_SCALARS; k++) {
        const Node *node = tree_at(tree, key_scalars[k].by);
        snprintf(names[k], NAME_SIZE, "%s", node && node->text ? node->text : "");
    }
}

/* A range of the file belongs to the file's scalar: makes the range automatic if the command line names a
   different scalar. */
static void range_of_scalar(const Tree *tree, const KeyScalar *scalar, const char *of_file, Scene *scene)
{
    static Scene usual;
    const Node *by = tree_at(tree, scalar->by), *range = tree_at(tree, scalar->range);
    const Key *key = scene_key_find(scalar->by);
    char before[NAME_SIZE], now[NAME_SIZE];
    scene_default(&usual);
    key_value_text(key, &usual, before, sizeof before);
    key_value_text(key, scene, now, sizeof now);
    if (!(range && range->said) && by && by->said &&
        strcmp(key_ranged(*of_file ? of_file : before), key_ranged(now)) != 0)
        key_range_free(scalar, scene);
}

/* Ranges of entries of `views`: an entry without a range takes the range of `view` if both have the same
   scalar. */
static void ranges_of_views(const Tree *tree, const KeyScalar *scalar, Scene *scene)
{
    const Key *views = scene_key_find("views"), *range = scene_key_find(scalar->range);
    for (int i = 0; i < scene->view_count; i++) {
        char path[64], *base = (char *)scene + key_list_at(views, i);
        snprintf(path, sizeof path, "views[%d]%s", i, scalar->range + strlen("view"));
        if (tree_at(tree, path))
            continue;
        *((bool *)base + range->aux) = *((bool *)scene + range->aux);
        key_range_follow(scalar, scene, base);
    }
}

static const char RECIPE[] = "preset=";

static bool is_recipe(const char *setting)
{
    return strncmp(setting, RECIPE, strlen(RECIPE)) == 0;
}

size_t scene_setting_key(const char *setting)
{
    return is_recipe(setting) ? strlen(setting) : strcspn(setting, "=");
}

/* Applies presets first, in any order: a single key overrides a preset. */
static bool apply_settings(Tree *tree, const SceneSettings *settings, Notes *notes, Error *error)
{
    for (int i = 0; i < settings->count; i++) {
        const char *set = settings->set[i], *said = settings->said[i];
        if (is_recipe(set) && !recipe_apply(tree, set + strlen(RECIPE), said ? said : set, notes, error))
            return false;
    }
    for (int i = 0; i < settings->count; i++)
        if (!is_recipe(settings->set[i]) && !tree_set(tree, settings->set[i], settings->said[i], error))
            return false;
    return true;
}

/* A box with width and height but no depth makes a two-dimensional scene. */
static int dimensions_of(const Tree *tree)
{
    const Node *size = tree_at(tree, "box.size");
    return size && size->kind == NODE_SEQUENCE && node_count(size) == 2 ? 2 : 3;
}

/* Reads the scene. A resumed run already has its particles and needs tables only to find the spacing for a
   count of particles. */
static bool read_scene(Tree *tree, const SceneSettings *settings, Scene *out, Notes *notes, Error *error)
{
    const bool needs_tables = !settings->recorded && (!settings->goes_on || settings->particles > 0);
    tree->dimensions = dimensions_of(tree);
    if (!scene_read(tree, out, error))
        return false;
    out->world.dimensions = tree->dimensions;
    snprintf(out->beside, sizeof out->beside, "%s", settings->beside ? settings->beside : "");
    return scene_read_meshes(tree, out, settings, notes, error) && scene_check(tree, out, error) &&
           (!needs_tables || scene_read_tables(tree, out, error));
}

/* Default thickness of a bowl's wall: enough to keep fluids apart, for the final spacing. */
static void solids_default(Scene *scene)
{
    WorldDef *world = &scene->world;
    for (int k = 0; k < world->solid_count; k++)
        if (world->solids[k].thickness == 0)
            world->solids[k].thickness = world->support * world->spacing;
}

/* Adjusts the spacing so that the fills have their exact mass. */
static void fit_spacing(const Tree *tree, Scene *scene, Notes *notes)
{
    WorldDef *world = &scene->world;
    const double asked = world->spacing, fits = fill_lattice_spacing(world);
    world->spacing = fits;
    if (fabs(fits / asked - 1) > 1e-6)
        advise(
            tree, "particles.spacing", notes,
            "%.6g m does not divide the fills into whole layers; %.6g m is taken, at which they reach from wall to wall",
            asked, fits);
}

/* Only for settings of the command line: the file of a recorded run is not of the user's making. */
static void advise_settings(const SceneSettings *settings, const Scene *scene, Notes *notes)
{
    for (int i = 0; i < settings->count; i++) {
        char path[128];
        snprintf(path, sizeof path, "%.*s", (int)strcspn(settings->set[i], "="), settings->set[i]);
        scene_unused(scene, path, notes);
    }
}

/* Warns of settings of `view` on the command line that entries of `views` override. */
static void advise_views(const Tree *tree, const SceneSettings *settings, const Scene *scene, Notes *notes)
{
    for (int i = 0; i < settings->count; i++) {
        char path[128], own[160], names[64] = "";
        const size_t view = strlen("view");
        snprintf(path, sizeof path, "%.*s", (int)strcspn(settings->set[i], "="), settings->set[i]);
        if (strncmp(path, "view.", view + 1) != 0)
            continue;
        for (int e = 0; e < scene->view_count; e++) {
            snprintf(own, sizeof own, "views[%d]%s", e, path + view);
            if (tree_at(tree, own))
                snprintf(names + strlen(names), sizeof names - strlen(names), "%sviews[%d]",
                         *names ? ", " : "", e);
        }
        if (*names)
            notes_add(notes, "%s does not reach %s, where it is said anew; views[N]%s=... does", path, names,
                      path + view);
    }
}

static bool choose_spacing(Tree *tree, SceneSettings *settings, Scene *out, Notes *notes, Error *error)
{
    const Node *spacing = tree_at(tree, "particles.spacing");
    if (settings->particles > 0 && spacing && spacing->said)
        return error_set(error, "--particles %zu and %.100s: both choose the spacing; leave one of them out",
                         settings->particles, spacing->said);
    if (settings->particles > 0 && !scene_set_particles(tree, out, settings, notes, error))
        return false;
    fit_spacing(tree, out, notes);
    return true;
}

static void set_defaults(const Tree *tree, Scene *out)
{
    if (out->world.dimensions == 2)
        out->world.box_size[2] = out->world.spacing;
    solids_default(out);
    snprintf(out->path, sizeof out->path, "%s", tree->path);
    title_default(out);
}

/* True if a view shows accelerations of this world; views of recorded runs and of different settings have
   worlds of their own. */
static bool shows_acceleration(const Scene *scene)
{
    for (int i = 0; i < scene_view_count(scene); i++) {
        const ViewDef *view = scene_view(scene, i);
        if (scene_shows(scene, view) && scene_view_accelerates(view))
            return true;
    }
    return false;
}

static bool fill_scene(Tree *tree, SceneSettings *settings, Scene *out, Notes *notes, Error *error)
{
    ScalarNames scalars;
    file_scalars(tree, scalars);
    if (!apply_settings(tree, settings, notes, error) || !read_scene(tree, settings, out, notes, error) ||
        !scene_read_view_files(tree, settings, out, notes, error))
        return false;
    out->purpose = settings->purpose;
    out->world.acceleration |= shows_acceleration(out);
    advise_views(tree, settings, out, notes);
    if (settings->recorded)
        advise_settings(settings, out, notes);
    else
        scene_advise_unused(tree, out, notes);
    for (int k = 0; k < KEY_SCALARS; k++) {
        range_of_scalar(tree, &key_scalars[k], scalars[k], out);
        ranges_of_views(tree, &key_scalars[k], out);
    }
    if (!settings->recorded && !choose_spacing(tree, settings, out, notes, error))
        return false;
    set_defaults(tree, out);
    if (settings->recorded)
        return true;
    if (!scene_check_count(tree, out, error))
        return false;
    scene_fit_step(tree, out, notes);
    scene_advise(tree, out, notes);
    return true;
}

bool scene_parse(const char *path, const char *bytes, size_t size, SceneSettings *settings, Scene *out,
                 Notes *notes, Error *error)
{
    SceneSettings none = {0};
    if (notes)
        notes->count = notes->lasting = 0;
    if (size > SCENE_BYTES_MAX)
        return error_set(error, "%s: larger than 1 MiB; a scene file is a page of YAML", path);
    Tree tree;
    const bool ok = tree_read(&tree, path, bytes, size, error) &&
                    fill_scene(&tree, settings ? settings : &none, out, notes, error);
    tree_free(&tree);
    return ok;
}

bool scene_load(const char *name, SceneSettings *settings, Scene *out, Notes *notes, Error *error)
{
    char path[SCENE_PATH_SIZE];
    size_t size;
    if (notes)
        notes->count = notes->lasting = 0;
    if (!scene_path_find(name, path, error))
        return false;
    char *bytes = scene_file_read(path, &size, error);
    if (!bytes)
        return false;
    const bool ok = scene_parse(path, bytes, size, settings, out, notes, error);
    free(bytes);
    return ok;
}
