/* Bytes of a device's reports: checksum, calibration, parser. Pure, no I/O. */
#ifndef APP_INPUT_DEVICE_REPORT_H
#define APP_INPUT_DEVICE_REPORT_H

#include "app/input/device/device.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Checksum in the last four bytes of Bluetooth reports of Sony's controllers: the CRC-32 of a byte for the
   kind of report, then of the report up to the checksum. */

enum { CHECKSUM_INPUT = 0xa1, CHECKSUM_FEATURE = 0xa3 }; /* kinds */

uint32_t checksum_of(uint8_t kind, const uint8_t *bytes, size_t size);

/* Calibration of a PlayStation controller's sensors: converts report numbers to rad/s and m/s2. Pure
   functions. After the feature reports read by Linux' drivers/hid/hid-playstation.c and SDL_hidapi_ps4.c. */

enum { CALIBRATION_BYTES_MAX = 64 };

typedef struct Calibration {
    double gyro_scale[3];         /* rad/s per count, around the sensor's x y z */
    double acceleration_zero[3];  /* counts */
    double acceleration_scale[3]; /* m/s2 per count */
} Calibration;

/* Returns the nominal calibration: 16 counts per degree/s and 8192 per g. */
Calibration calibration_nominal(void);

/* The feature report with the calibration. */
typedef struct CalibrationReport {
    uint8_t wake; /* feature report to read first: before, Bluetooth reports are short; 0: none */
    uint8_t id;
    uint8_t size; /* bytes including the id; 0: no calibration in this layout */
} CalibrationReport;

CalibrationReport calibration_report(ReportLayout layout);

/* Parses a feature report. Returns false and the nominal calibration if id, length or (Bluetooth) checksum
   are wrong. An axis with implausible numbers stays nominal: a scale not within a factor of two of
   nominal, or a zero more than half a g away. The gyro's bias only enters the scale and is not subtracted
   from reports, as in the maker's own driver: the integrating code must remove the remaining bias at rest. */
bool calibration_parse(ReportLayout layout, const uint8_t *bytes, size_t size, Calibration *out);

/* Parses the bytes of a report into a device's state: pure, no I/O. */

/* Longer than any report of a layout; longer reports, of audio, are cut and refused. */
enum { REPORT_BYTES_MAX = 128 };

/* Data needed to parse the reports of a device. */
typedef struct ReportFormat {
    const DeviceRow *row;
    ReportLayout layout; /* row->usb or row->bluetooth */
    Calibration calibration;
} ReportFormat;

/* Parses one report, `bytes` with its id first, at `time` (s). Returns true and updates `state`; values
   missing in the report stay. Returns false if id, length or checksum do not fit the layout: only
   state->refused changes. */
bool report_parse(const ReportFormat *format, const uint8_t *bytes, size_t size, double time,
                  DeviceState *state);

#endif
