/* Motion devices in the hand: from what one of them reports to where the box shall be. The one way for those
   in the window (app/held/hand_post.h) and for recordings in simulated time (app/held/hand_replay.h). Pure:
   no lock, no thread, no clock. */
#ifndef SLOSH_HELD_DEVICES_H
#define SLOSH_HELD_DEVICES_H

#include "app/device/devices.h"
#include "app/device/mapping.h"
#include "app/device/orientation.h"
#include "app/hand/hand.h"

enum { HELD_DEVICES_MAX = 8, HELD_PROBLEM_SIZE = 512, HELD_BUTTONS_MAX = 32 };

/* s without a report after which a device's rates count as none, as if it had been let go: one that is held
   off its rest reports all the time, so its link is broken. 3Dconnexion's own example programs do so too. */
#define HELD_SILENCE 0.5

typedef struct HeldDevice {
    int number; /* of DeviceEvent; 0: none is here */
    DeviceFamily family;
    uint16_t vendor, product;
    char name[64];
    char problem[HELD_PROBLEM_SIZE]; /* it may not be opened: why, and what would help; "" */
    DeviceState state;
    DeviceMap map;
    Orientation orientation;
    double silent; /* s since its last report */
} HeldDevice;

typedef struct HeldDevices {
    Mapping mapping;
    Hand hand;
    HandInput own;      /* all else that moves the box, and the picture's axes; its dt does not count */
    double box_size[3]; /* m */
    HeldDevice list[HELD_DEVICES_MAX]; /* in the order in which they came, without gaps */
    double left[4], without[4]; /* how the box was held when a device that turned it was last unplugged, by
                                   that turn and without it */
} HeldDevices;

/* None is there, and the box is at home. */
void held_devices_start(HeldDevices *held, const Mapping *mapping);

/* DEVICE_PLUGGED and DEVICE_REFUSED: one more; in place of those of its kind that were refused. False: there
   are too many. */
bool held_devices_add(HeldDevices *held, const DeviceEvent *event);

/* DEVICE_UNPLUGGED: the box stays where it was last told to be, though nothing holds it there any more.
   False, and *gone as it was: there is no such device. */
bool held_devices_remove(HeldDevices *held, int number, HeldDevice *gone);

/* DEVICE_REPORTED: takes the state over. The first pose of a device takes the place of one that was left by
   an unplugged device, so that it doesn't count twice when the same is plugged in again. False: there is no
   such device. `pressed` gets the commands of the
   buttons that went down. The pose follows with the next held_devices_update. */
bool held_devices_report(HeldDevices *held, const DeviceEvent *event, PlayCommand pressed[HELD_BUTTONS_MAX],
                         int *pressed_count);

/* dt seconds on. True: *target is where the box shall be, and is news. `camera` gains the rates of orbit
   right, up and zoom times dt. */
bool held_devices_update(HeldDevices *held, double dt, double camera[3], BoxTarget *target);

void held_devices_neutral(HeldDevices *held); /* the present poses become the neutral ones */
void held_devices_home(HeldDevices *held);    /* that too, and the box goes home, upright */

/* hand_let_go of all but the devices, which go on. */
void held_devices_let_go(HeldDevices *held, const BoxTarget *now);

/* The same, and that it is there is no news. */
void held_devices_follow(HeldDevices *held, const BoxTarget *target);

/* Whether it moves the box. */
bool held_device_in_use(const HeldDevice *device);

#endif
