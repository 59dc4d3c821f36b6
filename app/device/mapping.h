/* What the axes, the buttons and the pose of a motion device do: built in for each family, changed by a small
   YAML file and in the panel. Pure but for the functions that take a path.

   An axis goes through the dead zone, the curve, the gains and the inversion; then it moves or turns the box,
   or the camera. All directions are the user's: x to the right, y up, z towards him, turns right-handed about
   these; so a cap that is pushed to the right moves the box to the right of the picture. */
#ifndef SLOSH_MAPPING_H
#define SLOSH_MAPPING_H

#include "app/device/device_state.h"
#include "app/hand/hand.h"
#include "app/hand/play_commands.h"
#include "sim/base/error.h"

#include <stddef.h>
#include <stdio.h>

/* In the order of mapping_to_names. */
typedef enum MapTo {
    MAP_NOTHING,
    MAP_MOVE_X,
    MAP_MOVE_Y,
    MAP_MOVE_Z,
    MAP_TURN_X,
    MAP_TURN_Y,
    MAP_TURN_Z,
    MAP_ORBIT_X, /* of the camera, which has speeds only: the scene goes to the right */
    MAP_ORBIT_Y, /* up */
    MAP_ZOOM     /* nearer */
} MapTo;

typedef enum MapAs {
    MAP_RATE,  /* a speed: what is reached stays */
    MAP_OFFSET /* a way or an angle for as long as it is held */
} MapAs;

typedef struct AxisMap {
    int to, as;  /* MapTo, MapAs */
    double gain; /* 0 .. 10 */
    bool invert;
} AxisMap;

enum {
    MAPPING_AXES = 6,
    MAPPING_BUTTONS_MAX = 48, /* names of a family's buttons, all its products together */
    MAPPING_OWN_MAX = 8       /* products with an entry of their own */
};

typedef struct ButtonMap {
    const char *name; /* as device_table.c has it */
    int command;      /* PlayCommand, or PLAY_NONE */
} ButtonMap;

typedef struct DeviceMap {
    DeviceFamily family;
    double gain;      /* of all axes and the pose, 0 .. 10 */
    double dead_zone; /* of an axis's way, 0 .. 0.9 */
    double curve;     /* 1: straight; 2: a square, fine in the middle; 1 .. 5 */
    AxisMap axes[MAPPING_AXES];
    int pose;         /* whether the box turns as the device does */
    double pose_gain; /* the box's angle over the device's, 0 .. 4 */
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

/* What is built in. */
void mapping_default(Mapping *mapping);

/* The product's own entry, or its family's. */
DeviceMap *mapping_of(Mapping *mapping, DeviceFamily family, uint16_t vendor, uint16_t product);

/* NULL: the family has no button of that name. */
ButtonMap *device_map_button(DeviceMap *map, const char *name);

/* Names of the family's axes, and their values in a state: -1 .. 1. */
const char *mapping_axis_name(DeviceFamily family, int axis);
void mapping_axis_values(DeviceFamily family, const DeviceState *state, double values[MAPPING_AXES]);
const char *mapping_to_name(int to); /* NULL after the last */
bool mapping_has_pose(DeviceFamily family);

/* An axis's value behind dead zone, curve, gains and inversion. What is not finite counts as 0. */
double mapping_shape(const DeviceMap *map, int axis, double value);

/* Adds what the state's axes say to the hand's rates and offsets, and to the camera's speeds: orbit right and
   up, zoom; -1 .. 1 and more. */
void mapping_add(const DeviceMap *map, const DeviceState *state, HandInput *hand, double camera[3]);

/* The turn that the box takes of a device that is turned by `turned`: unit quaternions x y z w. */
void mapping_pose(const DeviceMap *map, const double turned[4], double out[4]);

/* The command of the button that the product reports in bit `bit`, or PLAY_NONE. */
PlayCommand mapping_button(const DeviceMap *map, uint16_t vendor, uint16_t product, int bit);

/* Reads a file's text on top of what is built in; `path` is what messages name. False with
   "path:line:column: what is wrong; what would be right", and *mapping as it was. */
bool mapping_parse(const char *path, const char *bytes, size_t size, Mapping *mapping, Error *error);

/* The file at `path`; where that is NULL the user's own ($XDG_CONFIG_HOME/slosh/mapping.yaml or
   ~/.config/slosh/mapping.yaml) if there is one, else what is built in. */
bool mapping_load(const char *path, Mapping *mapping, Error *error);

/* The path of the user's own file; false where no folder is known, or the path is too long. */
bool mapping_user_path(char path[1024]);

/* As a file that mapping_parse reads back to the same, with comments. */
void mapping_write(const Mapping *mapping, FILE *file);

/* That into a new file; one that is there stays as it is, and is an error. */
bool mapping_write_new(const Mapping *mapping, const char *path, Error *error);

/* In words, what each axis and button does. */
void mapping_explain(const Mapping *mapping, FILE *file);

#endif
