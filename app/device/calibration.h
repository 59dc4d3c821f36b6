/* Calibration of a PlayStation controller's sensors: converts report numbers to rad/s and m/s2. Pure
   functions. After the feature reports read by Linux' drivers/hid/hid-playstation.c and SDL_hidapi_ps4.c. */
#ifndef SLOSH_CALIBRATION_H
#define SLOSH_CALIBRATION_H

#include "app/device/device_table.h"

#include <stddef.h>

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

#endif
