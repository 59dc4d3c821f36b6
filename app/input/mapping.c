#include "app/input/input.h"

#include "app/base/file.h"
#include "app/base/program.h"
#include "app/input/device/device.h"
#include "app/scene/scene.h"
#include "app/scene/yaml/yaml.h"
#include "sim/base/key.h"
#include "sim/def.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const struct {
    const char *name, *words;
} targets[] = {
    [MAP_NOTHING] = {"nothing", "does nothing"},
    [MAP_MOVE_X] = {"move_x", "moves the box to the right"},
    [MAP_MOVE_Y] = {"move_y", "moves the box up"},
    [MAP_MOVE_Z] = {"move_z", "moves the box towards you"},
    [MAP_TURN_X] = {"turn_x", "tilts the box's top towards you"},
    [MAP_TURN_Y] = {"turn_y", "turns the box's near side to the right"},
    [MAP_TURN_Z] = {"turn_z", "tilts the box's top to the left"},
    [MAP_ORBIT_X] = {"orbit_x", "takes the camera round: the scene goes to the right"},
    [MAP_ORBIT_Y] = {"orbit_y", "takes the camera round: the scene goes up"},
    [MAP_ZOOM] = {"zoom", "brings the camera nearer"},
};

const char *mapping_to_name(int to)
{
    return to < (int)(sizeof targets / sizeof *targets) ? targets[to].name : NULL;
}

/* "moves the box to the right" */
static const char *mapping_to_words(int to)
{
    return targets[to].words;
}

static const char *as_name(int as)
{
    static const char *const names[] = {"rate", "offset", NULL};
    return names[as];
}

/* True for an action that a button may give: a press, no gesture. */
static bool is_press(const UserAction *action)
{
    return !action->gesture;
}

static const char *pose_name(int pose)
{
    static const char *const names[] = {"nothing", "box", NULL};
    return names[pose];
}

#define GAIN(TYPE, MEMBER, MOST, HELP)                                                                       \
    {                                                                                                        \
        .path = "gain", .type = KEY_NUMBER, .unit = "", .max = (MOST), .offset = offsetof(TYPE, MEMBER),     \
        .help = HELP                                                                                         \
    }

static const Key mapping_device_keys[] = {
    GAIN(DeviceMap, gain, 10, "of all axes and the pose"),
    {.path = "dead_zone",
     .type = KEY_NUMBER,
     .unit = "",
     .max = 0.9,
     .offset = offsetof(DeviceMap, dead_zone),
     .help = "so much of an axis's way about its middle counts as none"},
    {.path = "curve",
     .type = KEY_NUMBER,
     .unit = "",
     .min = 1,
     .max = 5,
     .offset = offsetof(DeviceMap, curve),
     .help = "1 is straight, 2 a square: fine in the middle, full at the end"},
    {.path = NULL},
};

static const Key mapping_axis_keys[] = {
    {.path = "to",
     .type = KEY_CHOICE,
     .flags = KEY_INDEX,
     .unit = "",
     .offset = offsetof(AxisMap, to),
     .choice = mapping_to_name,
     .help = "what it does"},
    {.path = "as",
     .type = KEY_CHOICE,
     .flags = KEY_INDEX,
     .unit = "",
     .offset = offsetof(AxisMap, as),
     .choice = as_name,
     .help = "a speed, or a way for as long as it is held; the camera has speeds only"},
    GAIN(AxisMap, gain, 10, "2: twice as much, though never more than the full speed, or way"),
    {.path = "invert",
     .type = KEY_BOOLEAN,
     .unit = "",
     .offset = offsetof(AxisMap, invert),
     .help = "the other way round"},
    {.path = NULL},
};

static const Key mapping_pose_keys[] = {
    {.path = "to",
     .type = KEY_CHOICE,
     .flags = KEY_INDEX,
     .unit = "",
     .offset = offsetof(DeviceMap, pose),
     .choice = pose_name,
     .help = "what is turned as the device is"},
    GAIN(DeviceMap, pose_gain, 4, "the box's angle over the device's"),
    {.path = NULL},
};

/* A cap's springs return within a few hundredths, worn sticks within a tenth. */
static const double CAP_DEAD_ZONE = 0.05, STICK_DEAD_ZONE = 0.1;

typedef struct ButtonDefault {
    const char *name;
    const UserAction *action;
} ButtonDefault;

static const ButtonDefault cap_buttons[] = {
    {"left", &action_box_home}, {"1", &action_box_home}, {"right", &action_pause},
    {"2", &action_pause},       {"menu", &action_pause}, {"fit", &action_camera_home},
};
static const ButtonDefault pad_buttons[] = {
    {"cross", &action_box_home},    {"triangle", &action_neutral},  {"options", &action_pause},
    {"square", &action_reset},      {"l1", &action_previous_scene}, {"r1", &action_next_scene},
    {"create", &action_screenshot}, {"share", &action_screenshot},
};

static const char *const cap_axes[MAPPING_AXES] = {"x", "y", "z", "turn_x", "turn_y", "turn_z"};
static const char *const pad_axes[MAPPING_AXES] = {"left_x",  "left_y",       "right_x",
                                                   "right_y", "left_trigger", "right_trigger"};

/* The cap moves and turns the box, at a speed, while deflected. */
static const AxisMap cap_defaults[MAPPING_AXES] = {
    {.to = MAP_MOVE_X, .gain = 1}, {.to = MAP_MOVE_Y, .gain = 1}, {.to = MAP_MOVE_Z, .gain = 1},
    {.to = MAP_TURN_X, .gain = 1}, {.to = MAP_TURN_Y, .gain = 1}, {.to = MAP_TURN_Z, .gain = 1},
};

/* The pose tilts the box, the left stick shakes the box, the right stick and the triggers move the camera.
   A stick's y is positive towards the user. */
static const AxisMap pad_defaults[MAPPING_AXES] = {
    {.to = MAP_MOVE_X, .as = MAP_OFFSET, .gain = 1},
    {.to = MAP_MOVE_Z, .as = MAP_OFFSET, .gain = 1},
    {.to = MAP_ORBIT_X, .gain = 1},
    {.to = MAP_ORBIT_Y, .gain = 1, .invert = true},
    {.to = MAP_ZOOM, .gain = 1, .invert = true},
    {.to = MAP_ZOOM, .gain = 1},
};

/* Returns NULL if the family has no button of that name. */
static ButtonMap *device_map_button(DeviceMap *map, const char *name)
{
    for (int i = 0; i < map->button_count; i++)
        if (strcmp(map->buttons[i].name, name) == 0)
            return &map->buttons[i];
    return NULL;
}

/* Collects the button names of all products of the family. */
static void collect_buttons(DeviceMap *map)
{
    for (const DeviceRow *row = device_rows; row->name; row++)
        for (int bit = 0; bit < DEVICE_BUTTONS_MAX && row->family == map->family; bit++)
            if (row->buttons[bit] && !device_map_button(map, row->buttons[bit]) &&
                map->button_count < MAPPING_BUTTONS_MAX)
                map->buttons[map->button_count++] = (ButtonMap){row->buttons[bit], NULL};
}

static void set_buttons(DeviceMap *map, const ButtonDefault *buttons, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        ButtonMap *button = device_map_button(map, buttons[i].name);
        if (button)
            button->action = buttons[i].action;
    }
}

static DeviceMap family_default(DeviceFamily family)
{
    const bool pad = mapping_has_pose(family);
    DeviceMap map = {.family = family,
                     .gain = 1,
                     .dead_zone = pad ? STICK_DEAD_ZONE : CAP_DEAD_ZONE,
                     .curve = 2,
                     .pose = pad,
                     .pose_gain = 1};
    memcpy(map.axes, pad ? pad_defaults : cap_defaults, sizeof map.axes);
    collect_buttons(&map);
    if (pad)
        set_buttons(&map, pad_buttons, sizeof pad_buttons / sizeof *pad_buttons);
    else
        set_buttons(&map, cap_buttons, sizeof cap_buttons / sizeof *cap_buttons);
    return map;
}

void mapping_default(Mapping *mapping)
{
    memset(mapping, 0, sizeof *mapping);
    for (int f = 0; f < DEVICE_FAMILY_COUNT; f++)
        mapping->family[f] = family_default((DeviceFamily)f);
}

DeviceMap *mapping_of(Mapping *mapping, DeviceFamily family, uint16_t vendor, uint16_t product)
{
    for (int i = 0; i < mapping->own_count; i++)
        if (mapping->own[i].vendor == vendor && mapping->own[i].product == product)
            return &mapping->own[i].map;
    return &mapping->family[family];
}

bool mapping_has_pose(DeviceFamily family)
{
    return family != DEVICE_SPACEMOUSE;
}

const char *mapping_axis_name(DeviceFamily family, int axis)
{
    return (mapping_has_pose(family) ? pad_axes : cap_axes)[axis];
}

void mapping_axis_values(DeviceFamily family, const DeviceState *state, double values[MAPPING_AXES])
{
    if (!mapping_has_pose(family)) {
        memcpy(values, state->cap, sizeof state->cap);
        return;
    }
    for (int k = 0; k < 2; k++) {
        values[k] = state->left[k];
        values[2 + k] = state->right[k];
        values[4 + k] = state->triggers[k];
    }
}

double mapping_shape(const DeviceMap *map, int axis, double value)
{
    const AxisMap *row = &map->axes[axis];
    const double way = fmin((fabs(value) - map->dead_zone) / (1 - map->dead_zone), 1);
    if (!(way > 0) || !isfinite(value))
        return 0;
    const double shaped = map->gain * row->gain * pow(way, map->curve);
    return (value < 0) == row->invert ? shaped : -shaped;
}

/* Signs: HandInput counts away from the user, while z counts towards the user; turns around z and x lean
   the top the opposite way. */
static void add_axis(const AxisMap *row, double value, HandInput *hand, double camera[3])
{
    const bool rate = row->as == MAP_RATE;
    double *move = rate ? hand->move_rate : hand->move_offset;
    double *tilt = rate ? hand->tilt_rate : hand->tilt_offset;
    switch ((MapTo)row->to) {
    case MAP_MOVE_X:
    case MAP_MOVE_Y:
        move[row->to - MAP_MOVE_X] += value;
        break;
    case MAP_MOVE_Z:
        move[2] -= value;
        break;
    case MAP_TURN_X:
        tilt[1] -= value;
        break;
    case MAP_TURN_Y:
        *(rate ? &hand->spin_rate : &hand->spin_offset) += value;
        break;
    case MAP_TURN_Z:
        tilt[0] -= value;
        break;
    case MAP_ORBIT_X:
    case MAP_ORBIT_Y:
    case MAP_ZOOM:
        camera[row->to - MAP_ORBIT_X] += value;
        break;
    case MAP_NOTHING:
        break;
    }
}

void mapping_add(const DeviceMap *map, const DeviceState *state, HandInput *hand, double camera[3])
{
    double values[MAPPING_AXES];
    mapping_axis_values(map->family, state, values);
    for (int i = 0; i < MAPPING_AXES; i++)
        add_axis(&map->axes[i], mapping_shape(map, i, values[i]), hand, camera);
}

void mapping_pose(const DeviceMap *map, const double turned[4], double out[4])
{
    const double sine = sqrt(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2]);
    const double side = turned[3] < 0 ? -1 : 1; /* the shorter of both ways round */
    const double angle = 2 * atan2(sine, side * turned[3]) * map->gain * map->pose_gain;
    double rotation[3] = {0};
    for (int k = 0; k < 3 && sine > 0; k++)
        rotation[k] = side * angle * turned[k] / sine;
    out[0] = out[1] = out[2] = 0;
    out[3] = 1;
    quat_turn(rotation, out);
}

const UserAction *mapping_button(const DeviceMap *map, uint16_t vendor, uint16_t product, int bit)
{
    const DeviceRow *row = device_row(vendor, product);
    const char *name = row && bit >= 0 && bit < DEVICE_BUTTONS_MAX ? row->buttons[bit] : NULL;
    for (int i = 0; name && i < map->button_count; i++)
        if (strcmp(map->buttons[i].name, name) == 0)
            return map->buttons[i].action;
    return NULL;
}

/* Reads a mapping file. */

enum { FILE_BYTES_MAX = 1 << 20, NAMES_MAX = MAPPING_BUTTONS_MAX + 4, SHOWN_SIZE = 96 };

typedef struct MappingReading {
    const YamlTree *tree;
    Error *error;
} MappingReading;

/* The valid names in a mapping. */
typedef struct NameList {
    int count;
    const char *names[NAMES_MAX];
} NameList;

static void names_add(NameList *names, const char *name)
{
    if (names->count < NAMES_MAX)
        names->names[names->count++] = name;
}

static bool unknown(const MappingReading *reading, const YamlNode *child, const NameList *names)
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

static bool is_mapping(const MappingReading *reading, const YamlNode *node, const char *shown,
                       const char *example)
{
    return node->kind == NODE_MAPPING ||
           tree_error(reading->tree, node, reading->error, "%s must be a mapping such as %s", shown, example);
}

/* Checks that all keys are in the list. */
static bool check_names(const MappingReading *reading, const YamlNode *mapping, const NameList *names)
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
static bool read_rows(const MappingReading *reading, const YamlNode *mapping, const Key *rows,
                      const char *shown, void *base)
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

static bool read_whole(const MappingReading *reading, const YamlNode *node, const Key *rows,
                       const char *shown, const char *example, void *base)
{
    NameList names = {0};
    for (const Key *row = rows; row->path; row++)
        names_add(&names, row->path);
    return is_mapping(reading, node, shown, example) && check_names(reading, node, &names) &&
           read_rows(reading, node, rows, shown, base);
}

static bool read_axes(const MappingReading *reading, const YamlNode *node, const char *shown, DeviceMap *map)
{
    NameList names = {0};
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

static bool read_action(const MappingReading *reading, const YamlNode *node, const char *shown,
                        const UserAction **action)
{
    const char *word = node->kind == NODE_SCALAR && node->text ? node->text : "";
    if (!*word)
        return tree_error(reading->tree, node, reading->error,
                          "%s must be a command of the window such as box-home, pause or neutral, or nothing",
                          shown);
    Suggestion near = suggest_for(word);
    if (strcmp(word, "nothing") == 0) {
        *action = NULL;
        return true;
    }
    for (const UserAction *const *at = user_actions; *at; at++) {
        if (!is_press(*at))
            continue;
        suggest_offer(&near, (*at)->name);
        if (strcmp((*at)->name, word) != 0)
            continue;
        *action = *at;
        return true;
    }
    return tree_error(reading->tree, node, reading->error,
                      "%s cannot be '%.40s'; %s%s%swrite a command of the window such as box-home, pause or "
                      "neutral, or nothing",
                      shown, word, near.best ? "did you mean '" : "", near.best ? near.best : "",
                      near.best ? "'? " : "");
}

static bool read_buttons(const MappingReading *reading, const YamlNode *node, const char *shown,
                         DeviceMap *map)
{
    NameList names = {0};
    for (int i = 0; i < map->button_count; i++)
        names_add(&names, map->buttons[i].name);
    if (!is_mapping(reading, node, shown, "{left: box-home}") || !check_names(reading, node, &names))
        return false;
    for (const YamlNode *child = node->first; child; child = child->next) {
        char path[SHOWN_SIZE];
        snprintf(path, sizeof path, "%.60s.%.20s", shown, child->key);
        if (!read_action(reading, child, path, &device_map_button(map, child->key)->action))
            return false;
    }
    return true;
}

static bool read_device(const MappingReading *reading, const YamlNode *node, DeviceMap *map)
{
    NameList names = {0};
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
static bool read_own(const MappingReading *reading, const YamlNode *node, unsigned vendor, unsigned product,
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

static bool read_root(const MappingReading *reading, const YamlNode *root, Mapping *mapping)
{
    NameList names = {0};
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
    const MappingReading reading = {tree, error};
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

/* Writes mappings as a file and in words. */

/* Writes "{to: move_x, as: rate, gain: 1, invert: false}". */
static void write_rows(const Key *rows, const void *base, FILE *file)
{
    fputc('{', file);
    for (const Key *row = rows; row->path; row++) {
        char value[64];
        key_value_text(row, base, value, sizeof value);
        fprintf(file, "%s%s: %s", row == rows ? "" : ", ", row->path, value);
    }
    fputc('}', file);
}

static const char *action_word(const UserAction *action)
{
    return action ? action->name : "nothing";
}

/* Writes the buttons with an action, here or in the reader's default; names the rest in a comment. */
static void write_buttons(const DeviceMap *map, const DeviceMap *begin, FILE *file)
{
    int others = 0;
    fprintf(file, "  buttons:\n");
    for (int i = 0; i < map->button_count; i++) {
        const ButtonMap *button = &map->buttons[i];
        if (button->action || begin->buttons[i].action)
            fprintf(file, "    %s: %s\n", button->name, action_word(button->action));
    }
    for (int i = 0; i < map->button_count; i++)
        if (!map->buttons[i].action)
            fprintf(file, "%s%s", others++ ? ", " : "    # also ", map->buttons[i].name);
    fprintf(file, others ? "\n" : "");
}

static void write_device(const DeviceMap *map, const DeviceMap *begin, FILE *file)
{
    for (const Key *row = mapping_device_keys; row->path; row++) {
        char value[64];
        key_value_text(row, map, value, sizeof value);
        fprintf(file, "  %s: %s\n", row->path, value);
    }
    if (mapping_has_pose(map->family)) {
        fprintf(file, "  pose: ");
        write_rows(mapping_pose_keys, map, file);
        fputc('\n', file);
    }
    fprintf(file, "  axes:\n");
    for (int i = 0; i < MAPPING_AXES; i++) {
        fprintf(file, "    %s: ", mapping_axis_name(map->family, i));
        write_rows(mapping_axis_keys, &map->axes[i], file);
        fputc('\n', file);
    }
    write_buttons(map, begin, file);
}

static void write_keys(const char *of, const Key *rows, FILE *file)
{
    for (const Key *row = rows; row->path; row++) {
        char range[256];
        key_range_text(row, range, sizeof range);
        fprintf(file, "#   %s%s: %s: %s\n", of, row->path, row->help, range);
    }
}

static void write_actions(FILE *file)
{
    for (const UserAction *const *at = user_actions; *at; at++)
        if (is_press(*at))
            fprintf(file, "#     %-16s %s\n", (*at)->name, (*at)->help);
}

void mapping_write(const Mapping *mapping, FILE *file)
{
    char user[1024];
    Mapping built_in;
    mapping_default(&built_in);
    fprintf(file, "# What the axes, the buttons and the pose of motion devices do.");
    if (mapping_user_path(user))
        fprintf(file, " slosh reads it as\n# %s, or where `--mapping FILE` says.", user);
    fprintf(file, "\n# Directions are yours: x to the right, y up, z towards you, turns right-handed about "
                  "these.\n# What is left out is as built in. Keys:\n");
    write_keys("", mapping_device_keys, file);
    write_keys("pose.", mapping_pose_keys, file);
    write_keys("axes.NAME.", mapping_axis_keys, file);
    fprintf(file, "#   buttons.NAME: nothing, or a command of the window:\n");
    write_actions(file);
    fprintf(file,
            "# A product may have an entry of its own, such as 256f:c635; it begins with its family's.\n");
    for (int f = 0; f < DEVICE_FAMILY_COUNT; f++) {
        fprintf(file, "\n%s:\n", device_family_word((DeviceFamily)f));
        write_device(&mapping->family[f], &built_in.family[f], file);
    }
    for (int i = 0; i < mapping->own_count; i++) {
        fprintf(file, "\n%04x:%04x:\n", mapping->own[i].vendor, mapping->own[i].product);
        write_device(&mapping->own[i].map, &mapping->family[mapping->own[i].map.family], file);
    }
}

bool mapping_write_new(const Mapping *mapping, const char *path, Error *error)
{
    FILE *file = fopen(path, "wx");
    if (!file && errno == EEXIST)
        return error_set(error, "%s: is there already, and stays as it is; name a new file", path);
    if (!file)
        return error_set(error, "%s: cannot be written (%s); name a file in a folder that is there", path,
                         strerror(errno));
    mapping_write(mapping, file);
    const bool failed = ferror(file) != 0;
    if (fclose(file) == 0 && !failed)
        return true;
    error_set(error, "%s: cannot be written whole (%s); make room for it", path, strerror(errno));
    remove(path);
    return false;
}

static void explain_axis(const DeviceMap *map, int axis, FILE *file)
{
    const AxisMap *row = &map->axes[axis];
    const bool speed = row->as == MAP_RATE || row->to >= MAP_ORBIT_X;
    fprintf(file, "  %-14s %s", mapping_axis_name(map->family, axis), mapping_to_words(row->to));
    if (row->to != MAP_NOTHING) {
        fprintf(file, speed ? ", as a speed" : ", for as long as it is held");
        if (row->gain != 1)
            fprintf(file, ", %g-fold", row->gain);
        if (row->invert)
            fprintf(file, ", the other way round");
    }
    fputc('\n', file);
}

static void explain_device(const DeviceMap *map, FILE *file)
{
    fprintf(file, "gain %g, dead zone %g, curve %g\n", map->gain, map->dead_zone, map->curve);
    if (map->pose)
        fprintf(file, "  %-14s turns the box as the device is turned, %g-fold\n", "pose", map->pose_gain);
    for (int i = 0; i < MAPPING_AXES; i++)
        explain_axis(map, i, file);
    for (int i = 0; i < map->button_count; i++)
        if (map->buttons[i].action)
            fprintf(file, "  %-14s %s\n", map->buttons[i].name, map->buttons[i].action->help);
}

void mapping_explain(const Mapping *mapping, FILE *file)
{
    for (int f = 0; f < DEVICE_FAMILY_COUNT; f++) {
        fprintf(file, "%s%s: ", f ? "\n" : "", device_family_title((DeviceFamily)f));
        explain_device(&mapping->family[f], file);
    }
    for (int i = 0; i < mapping->own_count; i++) {
        fprintf(file, "\n%s: ", device_row(mapping->own[i].vendor, mapping->own[i].product)->name);
        explain_device(&mapping->own[i].map, file);
    }
}
