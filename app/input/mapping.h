/* Mapping: the effect of a motion device's axes, buttons and pose. Built in per family, changeable by a
   small YAML file and in the panel. Pure, except the functions with a path.

   An axis passes dead zone, curve, gains and inversion, then moves or turns the box or the camera. All
   directions are the user's: x to the right, y up, z towards the user, right-handed turns: a cap pushed to
   the right moves the box to the right of the picture. */
#ifndef APP_INPUT_MAPPING_H
#define APP_INPUT_MAPPING_H

#include "app/input/device/device.h"
#include "app/input/hand.h"
#include "app/input/play_commands.h"
#include "slosh/error.h"

#include <stddef.h>
#include <stdio.h>

/* In the order of mapping_to_name. */
typedef enum MapTo {
    MAP_NOTHING,
    MAP_MOVE_X,
    MAP_MOVE_Y,
    MAP_MOVE_Z,
    MAP_TURN_X,
    MAP_TURN_Y,
    MAP_TURN_Z,
    MAP_ORBIT_X, /* of the camera, speeds only: the scene moves to the right */
    MAP_ORBIT_Y, /* up */
    MAP_ZOOM     /* nearer */
} MapTo;

typedef enum MapAs {
    MAP_RATE,  /* a speed: the box stays where it was moved */
    MAP_OFFSET /* an offset or angle while the axis is deflected */
} MapAs;

typedef struct AxisMap {
    int to, as;  /* MapTo, MapAs */
    double gain; /* 0 .. 10 */
    bool invert;
} AxisMap;

enum {
    MAPPING_AXES = 6,
    MAPPING_BUTTONS_MAX = 48, /* button names of a family, over all products */
    MAPPING_OWN_MAX = 8       /* products with their own entry */
};

typedef struct ButtonMap {
    const char *name; /* from device_rows */
    int command;      /* PlayCommand, or PLAY_NONE */
} ButtonMap;

typedef struct DeviceMap {
    DeviceFamily family;
    double gain;      /* for all axes and the pose, 0 .. 10 */
    double dead_zone; /* fraction of an axis's range, 0 .. 0.9 */
    double curve;     /* exponent, 1 .. 5; 1: linear; 2: square, fine near the middle */
    AxisMap axes[MAPPING_AXES];
    int pose;         /* true if the box follows the device's turn */
    double pose_gain; /* box's angle over the device's angle, 0 .. 4 */
    int button_count;
    ButtonMap buttons[MAPPING_BUTTONS_MAX];
} DeviceMap;

typedef struct Mapping {
    DeviceMap family[DEVICE_FAMILY_COUNT];
    int own_count;
    struct OwnMap {
        uint16_t vendor, product;
        DeviceMap map;
    } own[MAPPING_OWN_MAX];
} Mapping;

/* Fills in the built-in mapping. */
void mapping_default(Mapping *mapping);

/* Returns the product's own entry, or its family's. */
DeviceMap *mapping_of(Mapping *mapping, DeviceFamily family, uint16_t vendor, uint16_t product);

/* Names of the family's axes, and the axis values of a state: -1 .. 1. */
const char *mapping_axis_name(DeviceFamily family, int axis);
void mapping_axis_values(DeviceFamily family, const DeviceState *state, double values[MAPPING_AXES]);
const char *mapping_to_name(int to); /* NULL after the last */
bool mapping_has_pose(DeviceFamily family);

/* Applies dead zone, curve, gains and inversion to an axis's value. Infinite values and NaN count as 0. */
double mapping_shape(const DeviceMap *map, int axis, double value);

/* Adds the axes of a state to the hand's rates and offsets, and to the camera's speeds: orbit right and
   up, zoom; range -1 .. 1 and beyond. */
void mapping_add(const DeviceMap *map, const DeviceState *state, HandInput *hand, double camera[3]);

/* Computes the box's turn from a device turned by `turned`: unit quaternions x y z w. */
void mapping_pose(const DeviceMap *map, const double turned[4], double out[4]);

/* Returns the command of the product's button in bit `bit`, or PLAY_NONE. */
PlayCommand mapping_button(const DeviceMap *map, uint16_t vendor, uint16_t product, int bit);

/* Reads a file's text on top of the built-in mapping; `path` is for messages. Returns false with
   "path:line:column: problem; advice", and *mapping unchanged. */
bool mapping_parse(const char *path, const char *bytes, size_t size, Mapping *mapping, Error *error);

/* Loads the file at `path`. NULL: the user's own file ($XDG_CONFIG_HOME/slosh/mapping.yaml or
   ~/.config/slosh/mapping.yaml) if it exists, else the built-in mapping. */
bool mapping_load(const char *path, Mapping *mapping, Error *error);

/* Makes the path of the user's own file; returns false if no folder is known, or the path is too long. */
bool mapping_user_path(char path[1024]);

/* Writes the mapping as a file for mapping_parse, with comments. */
void mapping_write(const Mapping *mapping, FILE *file);

/* Writes the mapping into a new file; an existing file is an error and stays. */
bool mapping_write_new(const Mapping *mapping, const char *path, Error *error);

/* Describes each axis and button in words. */
void mapping_explain(const Mapping *mapping, FILE *file);

#endif
