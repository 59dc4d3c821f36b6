/* A motion device as the rest of the program sees it: what its last valid report said. Pure data; who parses
   is device/report.h, who asks the hardware device/devices.h. */
#ifndef SLOSH_DEVICE_STATE_H
#define SLOSH_DEVICE_STATE_H

#include "app/device/sensor_clock.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum DeviceFamily {
    DEVICE_SPACEMOUSE,
    DEVICE_DUALSHOCK4,
    DEVICE_DUALSENSE,
    DEVICE_FAMILY_COUNT
} DeviceFamily;

/* The frame of every device, whatever its maker's: +x to the user's right, +y up, +z towards the user, the
   device lying before him as it is meant to; turns are right-handed about these axes. */
typedef struct DeviceState {
    uint64_t reports; /* valid ones so far */
    uint64_t refused; /* of another length, id or checksum; they changed nothing else */
    double time;      /* s, of the last valid report, on the clock of wall_ms (a replay's: as recorded) */
    double cap[6];    /* SpaceMouse: x y z, turns about x y z; -1 .. 1; 0 for other families */
    double left[2], right[2];   /* sticks, -1 .. 1: right and down positive, as WindowGamepad */
    double triggers[2];         /* left, right; 0 .. 1 */
    uint32_t buttons;           /* as the family's report orders them: device/device_table.h names them */
    bool has_motion;            /* the two below were in the report */
    double angular_velocity[3]; /* rad/s about x y z, calibrated */
    double acceleration[3];     /* m/s2, what the accelerometer feels: +9.81 on y at rest */
    double late;                /* s from their measurement to `time`, by the device's own clock */
    SensorClock clock;          /* that */
} DeviceState;

#endif
