/* Table of the known motion devices: product, report layout, orientation of axes. */
#ifndef SLOSH_DEVICE_TABLE_H
#define SLOSH_DEVICE_TABLE_H

#include "app/device/device_state.h"

/* Layout of reports; report.h has the parsers. */
typedef enum ReportLayout {
    LAYOUT_SPACEMOUSE_W,   /* id 1: translation, id 2: rotation */
    LAYOUT_SPACEMOUSE_S,   /* id 1: both */
    LAYOUT_SPACEMOUSE_ANY, /* W or S: no source is known */
    LAYOUT_DUALSHOCK4_USB,
    LAYOUT_DUALSHOCK4_DONGLE, /* the same, with a bit for an absent controller */
    LAYOUT_DUALSHOCK4_BLUETOOTH,
    LAYOUT_DUALSENSE_USB,
    LAYOUT_DUALSENSE_BLUETOOTH,
    LAYOUT_COUNT
} ReportLayout;

/* An axis of device_state.h's frame is `sign` times the axis `from` of the reports. */
typedef struct DeviceAxis {
    uint8_t from; /* 0 .. 5 */
    int8_t sign;
} DeviceAxis;

typedef struct DeviceRow {
    uint16_t vendor, product;
    const char *name;
    DeviceFamily family;
    ReportLayout usb, bluetooth;
    const DeviceAxis *axes;     /* 6: a SpaceMouse's cap; else x y z of the gyro, then of the accelerometer */
    const char *const *buttons; /* DEVICE_BUTTONS_MAX names, NULL for missing buttons */
} DeviceRow;

enum { DEVICE_BUTTONS_MAX = 32 }; /* bits of DeviceState.buttons */

/* Ended by a row without a name. */
extern const DeviceRow device_rows[];

const DeviceRow *device_row(uint16_t vendor, uint16_t product); /* NULL: no known motion device */

/* device_family_word: "spacemouse", "dualshock4", "dualsense", for files. device_family_title: name for
   people. */
const char *device_family_word(DeviceFamily family);
const char *device_family_title(DeviceFamily family);

#endif
