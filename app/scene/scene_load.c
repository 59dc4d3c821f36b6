#include "app/scene/scene.h"

#include "app/base/program.h"
#include "app/scene/scene_private.h"
#include "app/scene/yaml/yaml.h"
#include "sim/base/base.h"
#include "sim/start/start.h"

#include <ctype.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { SHOWN_SIZE = 128 };

/* A mapping to read into a struct. */
typedef struct KeyPlace {
    const YamlTree *tree;
    const YamlNode *node;
    const char *parent;     /* path of the mapping's row; "" for the whole scene */
    char shown[SHOWN_SIZE]; /* the path with indices, for people */
    char *base;             /* base of the rows' offsets */
    Error *error;
} KeyPlace;

static bool read_mapping(const KeyPlace *place);

static void path_join(char out[SHOWN_SIZE], const char *parent, const char *name)
{
    snprintf(out, SHOWN_SIZE, "%.80s%s%.40s", parent, *parent ? "." : "", name);
}

static const char *last_of(const Key *key)
{
    const char *dot = strrchr(key->path, '.');
    return dot ? dot + 1 : key->path;
}

/* Suggests a key at a different place ("spacing" for particles.spacing); keys below `parent` come first. */
static const char *known_elsewhere(const char *name, const char *parent)
{
    int count;
    const Key *keys = scene_keys(&count), *best = NULL;
    Suggestion near = suggest_for(name);
    for (int round = 0; round < 2; round++)
        for (int i = 0; i < count; i++) {
            const int distance = near.distance;
            if (round == 1 || (*parent && strncmp(keys[i].path, parent, strlen(parent)) == 0))
                suggest_offer(&near, last_of(&keys[i]));
            if (near.distance < distance)
                best = &keys[i];
        }
    return best ? best->path : NULL;
}

/* True if the help of a kind contains "a WORD", such as "a ball". */
static bool is_a(const Key *kind, const char *word)
{
    const size_t length = strlen(word);
    for (const char *at = kind->help; (at = strstr(at, "a ")); at += 2)
        if ((at == kind->help || at[-1] == ' ') && strncmp(at + 2, word, length) == 0 &&
            !isalpha((unsigned char)at[2 + length]))
            return true;
    return false;
}

/* Lists have different words for one shape: a fill's ball is a solid's sphere. Returns the word of this list;
   NULL: none. */
static const char *kind_here(const KeyPlace *place, const char *word)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        const char *name = key_name_in(&keys[i], place->parent);
        if (!name || keys[i].type != KEY_VARIANT)
            continue;
        if (is_a(&keys[i], word))
            return name;
        for (int k = 0; k < count; k++)
            if (keys[k].type == KEY_VARIANT && strcmp(last_of(&keys[k]), word) == 0 && is_a(&keys[k], name))
                return name;
    }
    return NULL;
}

static bool unknown_key(const KeyPlace *place, const YamlNode *child)
{
    int count;
    const Key *keys = scene_keys(&count);
    Suggestion near = suggest_for(child->key);
    char known[512] = "";
    for (int i = 0; i < count; i++) {
        const char *name = key_name_in(&keys[i], place->parent);
        const size_t used = strlen(known);
        if (!name)
            continue;
        suggest_offer(&near, name);
        snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", name);
    }
    const char *here = near.best ? near.best : kind_here(place, child->key);
    if (here)
        return tree_error_key(place->tree, child, place->error, "unknown key '%.60s'; did you mean '%s'?",
                              child->key, here);
    const char *elsewhere = known_elsewhere(child->key, place->parent);
    if (elsewhere && strcmp(elsewhere, child->key) == 0)
        return tree_error_key(place->tree, child, place->error,
                              "'%.60s' cannot stand here; it is a key of the scene itself", child->key);
    if (elsewhere)
        return tree_error_key(place->tree, child, place->error,
                              "unknown key '%.60s' here; did you mean '%s'?", child->key, elsewhere);
    return tree_error_key(place->tree, child, place->error, "unknown key '%.60s'; known here: %s", child->key,
                          known);
}

static bool check_known(const KeyPlace *place)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (const YamlNode *child = place->node->first; child; child = child->next) {
        bool known = false;
        for (int i = 0; i < count && !known; i++) {
            const char *name = key_name_in(&keys[i], place->parent);
            known = name && strcmp(name, child->key) == 0;
        }
        if (!known)
            return unknown_key(place, child);
    }
    return true;
}

/* Writes the names of the variants below `parent`: "block, ball"; "" if none. */
static void variant_names(const char *parent, char *names, size_t size)
{
    int count;
    const Key *keys = scene_keys(&count);
    *names = 0;
    for (int i = 0; i < count; i++) {
        const char *name = key_name_in(&keys[i], parent);
        const size_t used = strlen(names);
        if (name && keys[i].type == KEY_VARIANT)
            snprintf(names + used, size - used, "%s%s", used ? ", " : "", name);
    }
}

/* Count of variants in the mapping. */
static int variant_count(const KeyPlace *place)
{
    int variants = 0;
    for (const YamlNode *child = place->node->first; child; child = child->next) {
        char path[SHOWN_SIZE];
        path_join(path, place->parent, child->key);
        const Key *key = scene_key_find(path);
        variants += key && key->type == KEY_VARIANT;
    }
    return variants;
}

static bool check_one_variant(const KeyPlace *place)
{
    char names[256];
    variant_names(place->parent, names, sizeof names);
    if (!*names || variant_count(place) == 1)
        return true;
    return tree_error(place->tree, place->node, place->error, "%s must have exactly one of: %s", place->shown,
                      names);
}

/* Initialises an element before its keys are read. */
static void list_begin(const KeyPlace *place, const Key *list, int index, char *element)
{
    const KeyListMapping *like = key_list_mapping(list);
    if (like)
        memcpy(element, place->base + like->at, list->size);
    else
        memset(element, 0, list->size);
    if (list->init)
        list->init(element, index);
}

/* Reads the elements of a list into `at`, which has room for them. */
static bool read_elements(const KeyPlace *place, const Key *key, const YamlNode *node, const char *shown,
                          char *at)
{
    const KeyListMapping *like = key_list_mapping(key);
    char parent[SHOWN_SIZE];
    snprintf(parent, sizeof parent, "%.120s%s", like ? like->mapping : key->path, like ? "" : "[]");
    int index = 0;
    for (const YamlNode *child = node->first; child; child = child->next, index++) {
        KeyPlace inner = {.tree = place->tree, .node = child, .parent = parent, .error = place->error};
        inner.base = at + (size_t)index * key->size;
        snprintf(inner.shown, SHOWN_SIZE, "%.110s[%d]", shown, index);
        list_begin(place, key, index, inner.base);
        inner.base -= like ? like->at : 0; /* the mapping's rows count from there */
        if (!read_mapping(&inner))
            return false;
    }
    return true;
}

/* Reads a list whose struct has a pointer to the elements. */
static bool read_kept_list(const KeyPlace *place, const Key *key, const YamlNode *node, const char *shown,
                           size_t elements)
{
    char *at = calloc(elements + 1, key->size);
    const void **list = (const void **)(void *)(place->base + key->offset);
    if (!at)
        return tree_error(place->tree, node, place->error, "out of memory for %s", shown);
    if (!read_elements(place, key, node, shown, at)) {
        free(at);
        return false;
    }
    *list = bytes_give(at, elements * key->size);
    return *list || elements == 0 ||
           tree_error(place->tree, node, place->error, "out of memory for %s", shown);
}

static bool read_list(const KeyPlace *place, const Key *key, const YamlNode *node, const char *shown)
{
    if (node->kind != NODE_SEQUENCE)
        return tree_error(place->tree, node, place->error, "%s must be a list: lines that begin with '-'",
                          shown);
    const size_t elements = node_count(node);
    if ((double)elements < key->min || (double)elements > key->max)
        return tree_error(place->tree, node, place->error, "%s has %zu %s; it must have %g to %g", shown,
                          elements, elements == 1 ? "entry" : "entries", key->min, key->max);
    const bool read = key->flags & KEY_POINTER
                          ? read_kept_list(place, key, node, shown, elements)
                          : read_elements(place, key, node, shown, place->base + key->offset);
    if (read)
        *(int *)(place->base + key->aux) = (int)elements;
    return read;
}

static bool read_key(const KeyPlace *place, const Key *key, const YamlNode *node, const char *shown)
{
    KeyPlace inner = {
        .tree = place->tree, .node = node, .parent = key->path, .base = place->base, .error = place->error};
    switch (key->type) {
    case KEY_LIST:
        return read_list(place, key, node, shown);
    case KEY_VARIANT:
        *(int *)(place->base + key->aux) = key->variant;
        break;
    case KEY_MAPPING:
        if (key->aux != KEY_NOWHERE)
            *(bool *)(place->base + key->aux) = false;
        break;
    default:
        return value_read(place->tree, key, node, shown, place->base, place->error);
    }
    snprintf(inner.shown, SHOWN_SIZE, "%s", shown);
    return read_mapping(&inner);
}

/* The first required key of a missing mapping, for the message. */
static const Key *required_below(const Key *mapping)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++)
        if (key_name_in(&keys[i], mapping->path) && keys[i].flags & KEY_REQUIRED)
            return &keys[i];
    return NULL;
}

/* Checks that `key` may be missing; a camera may lack all keys, a box may not. */
static bool check_missing(const KeyPlace *place, const Key *key, const char *shown)
{
    const bool optional = key->type == KEY_VARIANT || (key->type == KEY_MAPPING && key->aux != KEY_NOWHERE);
    const Key *lacking = key->flags & KEY_REQUIRED ? key : NULL;
    if (key->type == KEY_MAPPING && !optional)
        lacking = required_below(key);
    if (optional || !lacking)
        return true;
    const char *name = lacking == key ? shown : lacking->path;
    return tree_error(place->tree, place->node, place->error, "%s is missing: %s%s%s%s; add it", name,
                      lacking->help, *lacking->unit ? " (" : "", lacking->unit, *lacking->unit ? ")" : "");
}

static bool read_mapping(const KeyPlace *place)
{
    if (place->node->kind != NODE_MAPPING)
        return tree_error(place->tree, place->node, place->error,
                          "%s must be a mapping: lines of `key: value`", place->shown);
    if (!check_known(place) || !check_one_variant(place))
        return false;
    int count;
    const Key *keys = scene_keys(&count);
    for (int i = 0; i < count; i++) {
        const char *name = key_name_in(&keys[i], place->parent);
        char shown[SHOWN_SIZE];
        if (!name)
            continue;
        path_join(shown, place->shown, name);
        const YamlNode *child = node_child(place->node, name);
        if (!(child ? read_key(place, &keys[i], child, shown) : check_missing(place, &keys[i], shown)))
            return false;
    }
    return true;
}

/* Fills `scene` with defaults and the values of the tree; checks that each key is known, and each value has
   its type and range. Cross checks of keys are in scene_check. */
static bool scene_read(const YamlTree *tree, Scene *scene, Error *error)
{
    scene_default(scene);
    if (!solver_preset_apply(tree, scene, error))
        return false;
    const KeyPlace place = {
        .tree = tree, .node = tree->root, .parent = "", .base = (char *)scene, .error = error};
    return read_mapping(&place);
}

/* Loads a scene: the file, the command line, the checks and derived values. */

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
static void file_scalars(const YamlTree *tree, ScalarNames names)
{
    for (int k = 0; k < KEY_SCALARS; k++) {
        const YamlNode *node = tree_at(tree, key_scalars[k].by);
        snprintf(names[k], NAME_SIZE, "%s", node && node->text ? node->text : "");
    }
}

/* A range of the file belongs to the file's scalar: makes the range automatic if the command line names a
   different scalar. */
static void range_of_scalar(const YamlTree *tree, const KeyScalar *scalar, const char *of_file, Scene *scene)
{
    Scene usual;
    const YamlNode *by = tree_at(tree, scalar->by), *range = tree_at(tree, scalar->range);
    const Key *key = scene_key_find(scalar->by);
    char before[NAME_SIZE], now[NAME_SIZE];
    scene_default(&usual);
    key_value_text(key, &usual, before, sizeof before);
    key_value_text(key, scene, now, sizeof now);
    if (!(range && range->said) && by && by->said &&
        strcmp(key_range_scalar(*of_file ? of_file : before), key_range_scalar(now)) != 0)
        key_range_reset(scalar, scene);
}

/* Ranges of entries of `views`: an entry without a range takes the range of `view` if both have the same
   scalar. */
static void ranges_of_views(const YamlTree *tree, const KeyScalar *scalar, Scene *scene)
{
    const Key *views = scene_key_find("views"), *range = scene_key_find(scalar->range);
    for (int i = 0; i < scene->view_count; i++) {
        char path[64], *base = (char *)scene + key_list_at(views, i);
        snprintf(path, sizeof path, "views[%d]%s", i, scalar->range + strlen("view"));
        if (tree_at(tree, path))
            continue;
        *((bool *)base + range->aux) = *((bool *)scene + range->aux);
        key_range_update(scalar, scene, base);
    }
}

static const char PRESET[] = "preset=";

static bool is_preset(const char *setting)
{
    return strncmp(setting, PRESET, strlen(PRESET)) == 0;
}

size_t scene_setting_key(const char *setting)
{
    return is_preset(setting) ? strlen(setting) : strcspn(setting, "=");
}

/* Applies presets first, in any order: a single key overrides a preset. */
static bool apply_settings(YamlTree *tree, const SceneSettings *settings, Notes *notes, Error *error)
{
    for (int i = 0; i < settings->count; i++) {
        const char *set = settings->set[i], *said = settings->said[i];
        if (is_preset(set) && !preset_apply(tree, set + strlen(PRESET), said ? said : set, notes, error))
            return false;
    }
    for (int i = 0; i < settings->count; i++)
        if (!is_preset(settings->set[i]) && !tree_set(tree, settings->set[i], settings->said[i], error))
            return false;
    return true;
}

/* A box with width and height but no depth makes a two-dimensional scene. */
static int dimensions_of(const YamlTree *tree)
{
    const YamlNode *size = tree_at(tree, "box.size");
    return size && size->kind == NODE_SEQUENCE && node_count(size) == 2 ? 2 : 3;
}

/* Reads the scene. A resumed run already has its particles and needs tables only to find the spacing for a
   count of particles. */
static bool read_scene(YamlTree *tree, const SceneSettings *settings, Scene *out, Notes *notes, Error *error)
{
    const bool needs_tables = !settings->recorded && (!settings->goes_on || settings->particles > 0);
    tree->dimensions = dimensions_of(tree);
    if (!scene_read(tree, out, error))
        return false;
    out->world.dimensions = tree->dimensions;
    out->compared_set = settings->compared_set ? text_intern(settings->compared_set) : NULL;
    out->recorded = settings->recorded;
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
static void fit_spacing(const YamlTree *tree, Scene *scene, Notes *notes)
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
        scene_advise_key(scene, path, notes);
    }
}

/* Warns of settings of `view` on the command line that entries of `views` override. */
static void advise_views(const YamlTree *tree, const SceneSettings *settings, const Scene *scene,
                         Notes *notes)
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

static bool choose_spacing(YamlTree *tree, SceneSettings *settings, Scene *out, Notes *notes, Error *error)
{
    const YamlNode *spacing = tree_at(tree, "particles.spacing");
    if (settings->particles > 0 && spacing && spacing->said)
        return error_set(error, "--particles %zu and %.100s: both choose the spacing; leave one of them out",
                         settings->particles, spacing->said);
    if (settings->particles > 0 && !scene_choose_spacing(tree, out, settings, notes, error))
        return false;
    fit_spacing(tree, out, notes);
    return true;
}

static void set_defaults(const YamlTree *tree, Scene *out)
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
        if (scene_shows(scene, view) && scene_view_reads_acceleration(view))
            return true;
    }
    return false;
}

static bool fill_scene(YamlTree *tree, SceneSettings *settings, Scene *out, Notes *notes, Error *error)
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
    YamlTree tree;
    const bool ok = tree_read(&tree, path, bytes, size, error) &&
                    fill_scene(&tree, settings ? settings : &none, out, notes, error);
    tree_free(&tree);
    return ok;
}

bool scene_settings_add(SceneSettings *settings, const char *said, const char *set, Error *error)
{
    if (settings->count == SCENE_SETTINGS_MAX)
        return error_set(error, "more than %d settings; write them into a scene file", SCENE_SETTINGS_MAX);
    settings->said[settings->count] = said;
    settings->set[settings->count++] = set;
    return true;
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
