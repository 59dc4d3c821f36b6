#include "app/scene/read.h"

#include "app/base/suggest.h"
#include "app/scene/keys.h"
#include "app/scene/preset.h"
#include "app/yaml/value.h"

#include <ctype.h>
#include <stddef.h>
#include <string.h>

enum { PATH_SIZE = 128 };

/* A mapping to read into a struct. */
typedef struct Place {
    const Tree *tree;
    const Node *node;
    const char *parent;    /* path of the mapping's row; "" for the whole scene */
    char shown[PATH_SIZE]; /* the path with indices, for people */
    char *base;            /* base of the rows' offsets */
    Error *error;
} Place;

static bool read_mapping(const Place *place);

static void path_join(char out[PATH_SIZE], const char *parent, const char *name)
{
    snprintf(out, PATH_SIZE, "%.80s%s%.40s", parent, *parent ? "." : "", name);
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
static const char *kind_here(const Place *place, const char *word)
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

static bool unknown_key(const Place *place, const Node *child)
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

static bool check_known(const Place *place)
{
    int count;
    const Key *keys = scene_keys(&count);
    for (const Node *child = place->node->first; child; child = child->next) {
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
static int variant_count(const Place *place)
{
    int variants = 0;
    for (const Node *child = place->node->first; child; child = child->next) {
        char path[PATH_SIZE];
        path_join(path, place->parent, child->key);
        const Key *key = scene_key_find(path);
        variants += key && key->type == KEY_VARIANT;
    }
    return variants;
}

static bool check_one_variant(const Place *place)
{
    char names[256];
    variant_names(place->parent, names, sizeof names);
    if (!*names || variant_count(place) == 1)
        return true;
    return tree_error(place->tree, place->node, place->error, "%s must have exactly one of: %s", place->shown,
                      names);
}

/* Initialises an element before its keys are read. */
static void list_begin(const Place *place, const Key *list, int index, char *element)
{
    const KeyLike *like = key_like(list);
    if (like)
        memcpy(element, place->base + like->at, list->size);
    else
        memset(element, 0, list->size);
    if (list->init)
        list->init(element, index);
}

static bool read_list(const Place *place, const Key *key, const Node *node, const char *shown)
{
    if (node->kind != NODE_SEQUENCE)
        return tree_error(place->tree, node, place->error, "%s must be a list: lines that begin with '-'",
                          shown);
    const size_t elements = node_count(node);
    if ((double)elements < key->min || (double)elements > key->max)
        return tree_error(place->tree, node, place->error, "%s has %zu %s; it must have %g to %g", shown,
                          elements, elements == 1 ? "entry" : "entries", key->min, key->max);
    const KeyLike *like = key_like(key);
    char parent[PATH_SIZE];
    snprintf(parent, sizeof parent, "%.120s%s", like ? like->mapping : key->path, like ? "" : "[]");
    int index = 0;
    for (const Node *child = node->first; child; child = child->next, index++) {
        Place inner = {.tree = place->tree, .node = child, .parent = parent, .error = place->error};
        inner.base = place->base + key->offset + (size_t)index * key->size;
        snprintf(inner.shown, PATH_SIZE, "%.110s[%d]", shown, index);
        list_begin(place, key, index, inner.base);
        inner.base -= like ? like->at : 0; /* the mapping's rows count from there */
        if (!read_mapping(&inner))
            return false;
    }
    *(int *)(place->base + key->aux) = index;
    return true;
}

static bool read_key(const Place *place, const Key *key, const Node *node, const char *shown)
{
    Place inner = {
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
    snprintf(inner.shown, PATH_SIZE, "%s", shown);
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
static bool check_missing(const Place *place, const Key *key, const char *shown)
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

static bool read_mapping(const Place *place)
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
        char shown[PATH_SIZE];
        if (!name)
            continue;
        path_join(shown, place->shown, name);
        const Node *child = node_child(place->node, name);
        if (!(child ? read_key(place, &keys[i], child, shown) : check_missing(place, &keys[i], shown)))
            return false;
    }
    return true;
}

bool scene_read(const Tree *tree, Scene *scene, Error *error)
{
    scene_default(scene);
    if (!preset_apply(tree, scene, error))
        return false;
    const Place place = {
        .tree = tree, .node = tree->root, .parent = "", .base = (char *)scene, .error = error};
    return read_mapping(&place);
}
