#include "app/device/mapping.h"

#include "app/device/device_table.h"
#include "sim/box/box_motion.h"

#include <math.h>
#include <string.h>

/* A cap's springs return within a few hundredths, worn sticks within a tenth. */
static const double CAP_DEAD_ZONE = 0.05, STICK_DEAD_ZONE = 0.1;

typedef struct ButtonDefault {
    const char *name;
    PlayCommand command;
} ButtonDefault;

static const ButtonDefault cap_buttons[] = {
    {"left", PLAY_BOX_HOME}, {"1", PLAY_BOX_HOME}, {"right", PLAY_PAUSE},
    {"2", PLAY_PAUSE},       {"menu", PLAY_PAUSE}, {"fit", PLAY_CAMERA_HOME},
};
static const ButtonDefault pad_buttons[] = {
    {"cross", PLAY_BOX_HOME},    {"triangle", PLAY_NEUTRAL},  {"options", PLAY_PAUSE},
    {"square", PLAY_RESET},      {"l1", PLAY_PREVIOUS_SCENE}, {"r1", PLAY_NEXT_SCENE},
    {"create", PLAY_SCREENSHOT}, {"share", PLAY_SCREENSHOT},
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

ButtonMap *device_map_button(DeviceMap *map, const char *name)
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
                map->buttons[map->button_count++] = (ButtonMap){row->buttons[bit], PLAY_NONE};
}

static void set_buttons(DeviceMap *map, const ButtonDefault *buttons, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        ButtonMap *button = device_map_button(map, buttons[i].name);
        if (button)
            button->command = buttons[i].command;
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

PlayCommand mapping_button(const DeviceMap *map, uint16_t vendor, uint16_t product, int bit)
{
    const DeviceRow *row = device_row(vendor, product);
    const char *name = row && bit >= 0 && bit < DEVICE_BUTTONS_MAX ? row->buttons[bit] : NULL;
    for (int i = 0; name && i < map->button_count; i++)
        if (strcmp(map->buttons[i].name, name) == 0)
            return (PlayCommand)map->buttons[i].command;
    return PLAY_NONE;
}
