#include "app/device/mapping_keys.h"

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

const char *mapping_to_words(int to)
{
    return targets[to].words;
}

static const char *as_name(int as)
{
    static const char *const names[] = {"rate", "offset", NULL};
    return names[as];
}

const char *mapping_command_name(int command)
{
    const PlayCommandRow *row = &play_command_rows[command];
    return !row->name ? NULL : row->gesture ? "" : row->name;
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

const Key mapping_device_keys[] = {
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

const Key mapping_axis_keys[] = {
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

const Key mapping_pose_keys[] = {
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
