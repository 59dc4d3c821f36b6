/* State of a motion device for the rest of the program, from its last valid report. Pure data. Parser:
   device/report.h; hardware access: device/devices.h. */
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

/* All devices use one frame: +x to the user's right, +y up, +z towards the user, with the device held in
   front of the user in its normal position; turns are right-handed around these axes. */
typedef struct DeviceState {
    uint64_t reports; /* count of valid reports */
    uint64_t refused; /* count of reports of wrong length, id or checksum; ignored */
    double time;      /* s, of the last valid report, on the clock of wall_ms (in a replay: as recorded) */
    double cap[6];    /* SpaceMouse: x y z, turns around x y z; -1 .. 1; 0 for other families */
    double left[2], right[2];   /* sticks, -1 .. 1: right and down positive, like WindowGamepad */
    double triggers[2];         /* left, right; 0 .. 1 */
    uint32_t buttons;           /* bits in the order of the family's report; names in device/device_table.h */
    bool has_motion;            /* the report had the two values below */
    double angular_velocity[3]; /* rad/s around x y z, calibrated */
    double acceleration[3];     /* m/s2, accelerometer reading: +9.81 on y at rest */
    double late;                /* s from the measurement to `time`, by the device's own clock */
    SensorClock clock;          /* state of the device's clock */
} DeviceState;

#endif
