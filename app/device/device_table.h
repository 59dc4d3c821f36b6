/* The motion devices that slosh knows, as data: which product sends which reports, and how its axes lie. */
#ifndef SLOSH_DEVICE_TABLE_H
#define SLOSH_DEVICE_TABLE_H

#include "app/device/device_state.h"

/* What a report looks like; report.h parses them. */
typedef enum ReportLayout {
    LAYOUT_SPACEMOUSE_W,   /* id 1 has the translation, id 2 the rotation */
    LAYOUT_SPACEMOUSE_S,   /* id 1 has both */
    LAYOUT_SPACEMOUSE_ANY, /* one of the two: no source says which */
    LAYOUT_DUALSHOCK4_USB,
    LAYOUT_DUALSHOCK4_DONGLE, /* the same, with a bit for the absent controller */
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
    const DeviceAxis *axes; /* 6: a SpaceMouse's cap; else the gyro's and then the accelerometer's x y z */
    const char *const *buttons; /* DEVICE_BUTTONS_MAX names, NULL where the device has none */
} DeviceRow;

enum { DEVICE_BUTTONS_MAX = 32 }; /* bits of DeviceState.buttons */

/* Ended by a row without a name. */
extern const DeviceRow device_rows[];

const DeviceRow *device_row(uint16_t vendor, uint16_t product); /* NULL: no motion device, or none known */

/* "spacemouse", "dualshock4", "dualsense": for files; and as people call it. */
const char *device_family_word(DeviceFamily family);
const char *device_family_title(DeviceFamily family);

#endif
