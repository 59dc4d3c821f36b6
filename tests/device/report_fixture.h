/* Reports of motion devices, made byte by byte from the layouts' descriptions, for the tests of the parsers.
 */
#ifndef SLOSH_TESTS_REPORT_FIXTURE_H
#define SLOSH_TESTS_REPORT_FIXTURE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "app/input/device/report.h"

#include <string.h>

typedef struct Report {
    uint8_t bytes[REPORT_BYTES_MAX];
    size_t size;
} Report;

static inline void put_i16(uint8_t *bytes, int value)
{
    bytes[0] = (uint8_t)(value & 255);
    bytes[1] = (uint8_t)(value >> 8 & 255);
}

static inline void seal(uint8_t kind, uint8_t *bytes, size_t size)
{
    const uint32_t sum = checksum_of(kind, bytes, size - 4);
    for (int i = 0; i < 4; i++)
        bytes[size - 4 + (size_t)i] = (uint8_t)(sum >> 8 * i);
}

/* Layout of a sensor report. */
typedef struct LayoutFacts {
    uint8_t id;
    size_t size, payload;
    size_t sticks, triggers, buttons, gyro, accelerometer; /* in the payload */
    bool sealed;
} LayoutFacts;

static const LayoutFacts layout_facts[LAYOUT_COUNT] = {
    [LAYOUT_SPACEMOUSE_W] = {.id = 1, .size = 7, .payload = 1},
    [LAYOUT_SPACEMOUSE_S] = {.id = 1, .size = 13, .payload = 1},
    [LAYOUT_SPACEMOUSE_ANY] = {.id = 1, .size = 13, .payload = 1},
    [LAYOUT_DUALSHOCK4_USB] = {0x01, 64, 1, 0, 7, 4, 12, 18, false},
    [LAYOUT_DUALSHOCK4_DONGLE] = {0x01, 64, 1, 0, 7, 4, 12, 18, false},
    [LAYOUT_DUALSHOCK4_BLUETOOTH] = {0x11, 78, 3, 0, 7, 4, 12, 18, true},
    [LAYOUT_DUALSENSE_USB] = {0x01, 64, 1, 0, 4, 7, 15, 21, false},
    [LAYOUT_DUALSENSE_BLUETOOTH] = {0x31, 78, 2, 0, 4, 7, 15, 21, true},
};

static inline bool is_cap(ReportLayout layout)
{
    return layout <= LAYOUT_SPACEMOUSE_ANY;
}

/* A valid report without presses and motion. */
static inline Report rest_report(ReportLayout layout)
{
    const LayoutFacts *facts = &layout_facts[layout];
    Report report = {.size = facts->size};
    report.bytes[0] = facts->id;
    if (!is_cap(layout)) {
        memset(report.bytes + facts->payload + facts->sticks, 128, 4);
        report.bytes[facts->payload + facts->buttons] = 8;
    }
    if (facts->sealed)
        seal(CHECKSUM_INPUT, report.bytes, report.size);
    return report;
}

/* The same with the six axes of the sensors, in counts: of a cap x y z and turns; else gyro, accelerometer. W
   has a report for three of them each: `second`. */
static inline Report axes_report(ReportLayout layout, const int counts[6], bool second)
{
    const LayoutFacts *facts = &layout_facts[layout];
    Report report = rest_report(layout);
    if (layout == LAYOUT_SPACEMOUSE_W && second)
        report.bytes[0] = 2;
    const int first = layout == LAYOUT_SPACEMOUSE_W && second ? 3 : 0;
    for (int k = 0; k < (layout == LAYOUT_SPACEMOUSE_W ? 3 : 6); k++) {
        const size_t at = is_cap(layout) ? 2 * (size_t)k
                          : k < 3        ? facts->gyro + 2 * (size_t)k
                                         : facts->accelerometer + 2 * (size_t)(k - 3);
        put_i16(report.bytes + facts->payload + at, counts[first + k]);
    }
    if (facts->sealed)
        seal(CHECKSUM_INPUT, report.bytes, report.size);
    return report;
}

static inline ReportFormat format_of(uint16_t vendor, uint16_t product, bool bluetooth)
{
    const DeviceRow *row = device_row(vendor, product);
    assert_non_null(row);
    return (ReportFormat){
        .row = row, .layout = bluetooth ? row->bluetooth : row->usb, .calibration = calibration_nominal()};
}

/* Some device of that layout. */
static inline ReportFormat format_with(ReportLayout layout)
{
    for (const DeviceRow *row = device_rows; row->name; row++)
        if (row->usb == layout || row->bluetooth == layout)
            return format_of(row->vendor, row->product, row->usb != layout);
    fail_msg("no device has layout %d", (int)layout);
    return (ReportFormat){0};
}

#endif
