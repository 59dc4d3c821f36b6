/* Reads a mapping file. */
#include "app/base/file.h"
#include "app/base/program.h"
#include "app/device/device_table.h"
#include "app/device/mapping_keys.h"
#include "app/scene/yaml/yaml.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILE_BYTES_MAX = 1 << 20, NAMES_MAX = MAPPING_BUTTONS_MAX + 4, SHOWN_SIZE = 96 };

typedef struct Reading {
    const YamlTree *tree;
    Error *error;
} Reading;

/* The valid names in a mapping. */
typedef struct Names {
    int count;
    const char *names[NAMES_MAX];
} Names;

static void names_add(Names *names, const char *name)
{
    if (names->count < NAMES_MAX)
        names->names[names->count++] = name;
}

static bool unknown(const Reading *reading, const YamlNode *child, const Names *names)
{
    Suggestion near = suggest_for(child->key);
    char known[512] = "";
    for (int i = 0; i < names->count; i++) {
        const size_t used = strlen(known);
        suggest_offer(&near, names->names[i]);
        snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", names->names[i]);
    }
    if (near.best)
        return tree_error_key(reading->tree, child, reading->error, "unknown key '%.60s'; did you mean '%s'?",
                              child->key, near.best);
    return tree_error_key(reading->tree, child, reading->error, "unknown key '%.60s'; known here: %s",
                          child->key, known);
}

static bool is_mapping(const Reading *reading, const YamlNode *node, const char *shown, const char *example)
{
    return node->kind == NODE_MAPPING ||
           tree_error(reading->tree, node, reading->error, "%s must be a mapping such as %s", shown, example);
}

/* Checks that all keys are in the list. */
static bool check_names(const Reading *reading, const YamlNode *mapping, const Names *names)
{
    for (const YamlNode *child = mapping->first; child; child = child->next) {
        bool known = false;
        for (int i = 0; i < names->count && !known; i++)
            known = strcmp(names->names[i], child->key) == 0;
        if (!known)
            return unknown(reading, child, names);
    }
    return true;
}

/* Reads the values of the present rows. */
static bool read_rows(const Reading *reading, const YamlNode *mapping, const Key *rows, const char *shown,
                      void *base)
{
    for (const Key *row = rows; row->path; row++) {
        const YamlNode *child = node_child(mapping, row->path);
        char path[SHOWN_SIZE];
        snprintf(path, sizeof path, "%.60s.%.20s", shown, row->path);
        if (child && !value_read(reading->tree, row, child, path, base, reading->error))
            return false;
    }
    return true;
}

static bool read_whole(const Reading *reading, const YamlNode *node, const Key *rows, const char *shown,
                       const char *example, void *base)
{
    Names names = {0};
    for (const Key *row = rows; row->path; row++)
        names_add(&names, row->path);
    return is_mapping(reading, node, shown, example) && check_names(reading, node, &names) &&
           read_rows(reading, node, rows, shown, base);
}

static bool read_axes(const Reading *reading, const YamlNode *node, const char *shown, DeviceMap *map)
{
    Names names = {0};
    for (int i = 0; i < MAPPING_AXES; i++)
        names_add(&names, mapping_axis_name(map->family, i));
    if (!is_mapping(reading, node, shown, "{x: {to: move_x}}") || !check_names(reading, node, &names))
        return false;
    for (int i = 0; i < MAPPING_AXES; i++) {
        const YamlNode *child = node_child(node, names.names[i]);
        char path[SHOWN_SIZE];
        snprintf(path, sizeof path, "%.60s.%s", shown, names.names[i]);
        if (child &&
            !read_whole(reading, child, mapping_axis_keys, path, "{to: move_x, as: rate}", &map->axes[i]))
            return false;
    }
    return true;
}

static bool read_command(const Reading *reading, const YamlNode *node, const char *shown, int *command)
{
    const char *word = node->kind == NODE_SCALAR && node->text ? node->text : "";
    if (!*word)
        return tree_error(reading->tree, node, reading->error,
                          "%s must be a command of the window such as box-home, pause or neutral, or nothing",
                          shown);
    Suggestion near = suggest_for(word);
    if (strcmp(word, "nothing") == 0) {
        *command = PLAY_NONE;
        return true;
    }
    const char *name;
    for (int i = 0; (name = mapping_command_name(i)); i++) {
        suggest_offer(&near, name);
        if (!*name || strcmp(name, word) != 0)
            continue;
        *command = i;
        return true;
    }
    return tree_error(reading->tree, node, reading->error,
                      "%s cannot be '%.40s'; %s%s%swrite a command of the window such as box-home, pause or "
                      "neutral, or nothing",
                      shown, word, near.best ? "did you mean '" : "", near.best ? near.best : "",
                      near.best ? "'? " : "");
}

static bool read_buttons(const Reading *reading, const YamlNode *node, const char *shown, DeviceMap *map)
{
    Names names = {0};
    for (int i = 0; i < map->button_count; i++)
        names_add(&names, map->buttons[i].name);
    if (!is_mapping(reading, node, shown, "{left: box-home}") || !check_names(reading, node, &names))
        return false;
    for (const YamlNode *child = node->first; child; child = child->next) {
        char path[SHOWN_SIZE];
        snprintf(path, sizeof path, "%.60s.%.20s", shown, child->key);
        if (!read_command(reading, child, path, &device_map_button(map, child->key)->command))
            return false;
    }
    return true;
}

static bool read_device(const Reading *reading, const YamlNode *node, DeviceMap *map)
{
    Names names = {0};
    char path[SHOWN_SIZE];
    for (const Key *row = mapping_device_keys; row->path; row++)
        names_add(&names, row->path);
    names_add(&names, "axes");
    names_add(&names, "buttons");
    if (mapping_has_pose(map->family))
        names_add(&names, "pose");
    if (!is_mapping(reading, node, node->key, "{gain: 1, axes: {...}}") ||
        !check_names(reading, node, &names) || !read_rows(reading, node, mapping_device_keys, node->key, map))
        return false;
    const YamlNode *axes = node_child(node, "axes"), *buttons = node_child(node, "buttons"),
                   *pose = node_child(node, "pose");
    snprintf(path, sizeof path, "%.40s.axes", node->key);
    if (axes && !read_axes(reading, axes, path, map))
        return false;
    snprintf(path, sizeof path, "%.40s.buttons", node->key);
    if (buttons && !read_buttons(reading, buttons, path, map))
        return false;
    snprintf(path, sizeof path, "%.40s.pose", node->key);
    return !pose || read_whole(reading, pose, mapping_pose_keys, path, "{to: box, gain: 1}", map);
}

/* Parses "256f:c635"; returns false on failure. */
static bool is_product(const char *key, unsigned *vendor, unsigned *product)
{
    int end = 0;
    static const char hex[] = "0123456789abcdefABCDEF";
    return strlen(key) == 9 && strspn(key, hex) == 4 && key[4] == ':' && strspn(key + 5, hex) == 4 &&
           sscanf(key, "%4x:%4x%n", vendor, product, &end) == 2 && end == 9;
}

/* Reads a product's entry, starting with its family's values. */
static bool read_own(const Reading *reading, const YamlNode *node, unsigned vendor, unsigned product,
                     Mapping *mapping)
{
    const DeviceRow *row = device_row((uint16_t)vendor, (uint16_t)product);
    if (!row)
        return tree_error_key(reading->tree, node, reading->error,
                              "slosh knows no device %.9s; `slosh devices` lists those it knows", node->key);
    if (mapping->own_count == MAPPING_OWN_MAX)
        return tree_error_key(reading->tree, node, reading->error,
                              "more than %d products; write what they share under %s", MAPPING_OWN_MAX,
                              device_family_word(row->family));
    for (int i = 0; i < mapping->own_count; i++) /* different case: 256F:C635 */
        if (mapping->own[i].vendor == vendor && mapping->own[i].product == product)
            return tree_error_key(reading->tree, node, reading->error,
                                  "%.9s stands here twice; keep one of the two", node->key);
    struct OwnMap *own = &mapping->own[mapping->own_count++];
    *own = (struct OwnMap){(uint16_t)vendor, (uint16_t)product, mapping->family[row->family]};
    return read_device(reading, node, &own->map);
}

static bool read_root(const Reading *reading, const YamlNode *root, Mapping *mapping)
{
    Names names = {0};
    unsigned vendor, product;
    for (int f = 0; f < DEVICE_FAMILY_COUNT; f++)
        names_add(&names, device_family_word((DeviceFamily)f));
    for (int f = 0; f < DEVICE_FAMILY_COUNT; f++) {
        const YamlNode *child = node_child(root, names.names[f]);
        if (child && !read_device(reading, child, &mapping->family[f]))
            return false;
    }
    for (const YamlNode *child = root->first; child; child = child->next) {
        bool family = false;
        for (int f = 0; f < DEVICE_FAMILY_COUNT; f++)
            family = family || strcmp(names.names[f], child->key) == 0;
        if (family)
            continue;
        if (!is_product(child->key, &vendor, &product)) {
            names_add(&names, "or a product such as 256f:c635");
            return unknown(reading, child, &names);
        }
        if (!read_own(reading, child, vendor, product, mapping))
            return false;
    }
    return true;
}

static bool read_text(YamlTree *tree, const char *bytes, size_t size, Mapping *mapping, Error *error)
{
    static const char right[] = "write `dualsense:` or another family at the left margin; `slosh devices "
                                "--write-mapping FILE` writes one to begin with";
    const Reading reading = {tree, error};
    YamlNode *root = NULL;
    if (!yaml_read(tree, NULL, bytes, size, &root, error))
        return false;
    if (!root)
        return error_set(error, "%s:1:1: the mapping is empty; %s", tree->path, right);
    tree->root = root;
    return root->kind == NODE_MAPPING ? read_root(&reading, root, mapping)
                                      : tree_error(tree, root, error, "no mapping; %s", right);
}

bool mapping_parse(const char *path, const char *bytes, size_t size, Mapping *mapping, Error *error)
{
    YamlTree tree = {.path = path};
    Mapping read;
    mapping_default(&read);
    const bool ok = read_text(&tree, bytes, size, &read, error);
    tree_free(&tree);
    if (ok)
        *mapping = read;
    return ok;
}

bool mapping_user_path(char path[1024])
{
    char folder[PROGRAM_PATH_SIZE];
    return program_user_folder(folder) && snprintf(path, 1024, "%s/mapping.yaml", folder) < 1024;
}

static bool read_mapping(const char *path, Mapping *mapping, Error *error)
{
    size_t size;
    char *bytes = read_file(path, FILE_BYTES_MAX, "mapping", &size, error);
    const bool ok = bytes && mapping_parse(path, bytes, size, mapping, error);
    free(bytes);
    return ok;
}

bool mapping_load(const char *path, Mapping *mapping, Error *error)
{
    char own[1024];
    mapping_default(mapping);
    if (!path && mapping_user_path(own) && access(own, F_OK) == 0)
        path = own;
    return !path || read_mapping(path, mapping, error);
}
