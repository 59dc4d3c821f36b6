/* Motion devices in the hand: from reports to a target of the box. Used for devices in the window
   (app/held/hand_post.h) and for recordings in simulated time (app/held/hand_replay.h). Pure: no lock,
   thread or clock. */
#ifndef SLOSH_HELD_DEVICES_H
#define SLOSH_HELD_DEVICES_H

#include "app/device/devices.h"
#include "app/device/mapping.h"
#include "app/device/orientation.h"
#include "app/hand/hand.h"

enum { HELD_DEVICES_MAX = 8, HELD_PROBLEM_SIZE = 512, HELD_BUTTONS_MAX = 32 };

/* s without a report until a device's rates count as zero, as if released: a deflected device reports all
   the time, so the link is broken. 3Dconnexion's example programs do the same. */
#define HELD_SILENCE 0.5

typedef struct HeldDevice {
    int number; /* of DeviceEvent; 0: unused entry */
    DeviceFamily family;
    uint16_t vendor, product;
    char name[64];
    char problem[HELD_PROBLEM_SIZE]; /* why the device may not be opened, with advice; or "" */
    DeviceState state;
    DeviceMap map;
    Orientation orientation;
    double silent; /* s since its last report */
} HeldDevice;

typedef struct HeldDevices {
    Mapping mapping;
    Hand hand;
    HandInput own;                     /* all other input for the box, and the picture's axes; without dt */
    double box_size[3];                /* m */
    HeldDevice list[HELD_DEVICES_MAX]; /* in the order of plugging in, without gaps */
    double left[4], without[4]; /* box orientation at the unplugging of the last turning device: with and
                                   without the device's turn */
} HeldDevices;

/* Starts without devices, the box at home. */
void held_devices_start(HeldDevices *held, const Mapping *mapping);

/* Handles DEVICE_PLUGGED and DEVICE_REFUSED: adds a device, replacing refused devices of its kind. Returns
   false if there are too many. */
bool held_devices_add(HeldDevices *held, const DeviceEvent *event);

/* Handles DEVICE_UNPLUGGED: the box stays at its last target, though no longer held there. Returns false,
   with *gone unchanged, if there is no such device. */
bool held_devices_remove(HeldDevices *held, int number, HeldDevice *gone);

/* Handles DEVICE_REPORTED: takes over the state. A device's first pose replaces the pose left by an
   unplugged device, so that a device plugged in again does not count twice. Returns false if there is no
   such device. `pressed` gets the commands of newly pressed buttons. The pose takes effect in the next
   held_devices_update. */
bool held_devices_report(HeldDevices *held, const DeviceEvent *event, PlayCommand pressed[HELD_BUTTONS_MAX],
                         int *pressed_count);

/* Advances by dt seconds. Returns true if *target has a new target. `camera` gains the rates of orbit
   right, up and zoom times dt. */
bool held_devices_update(HeldDevices *held, double dt, double camera[3], BoxTarget *target);

void held_devices_neutral(HeldDevices *held); /* makes the present poses neutral */
void held_devices_home(HeldDevices *held);    /* likewise, and moves the box home, upright */

/* hand_let_go of all input except the devices, which go on. */
void held_devices_let_go(HeldDevices *held, const BoxTarget *now);

/* Likewise, without reporting the new target as news. */
void held_devices_follow(HeldDevices *held, const BoxTarget *target);

/* True if the device moves the box. */
bool held_device_in_use(const HeldDevice *device);

#endif
