/* What a PlayStation controller knows about its own sensors: from numbers of its reports to rad/s and m/s2.
   Pure. After the feature reports that Linux' drivers/hid/hid-playstation.c and SDL_hidapi_ps4.c read. */
#ifndef SLOSH_CALIBRATION_H
#define SLOSH_CALIBRATION_H

#include "app/device/device_table.h"

#include <stddef.h>

enum { CALIBRATION_BYTES_MAX = 64 };

typedef struct Calibration {
    double gyro_scale[3];         /* rad/s a count, about the sensor's x y z */
    double acceleration_zero[3];  /* counts */
    double acceleration_scale[3]; /* m/s2 a count */
} Calibration;

/* 16 counts per degree/s and 8192 per g. */
Calibration calibration_nominal(void);

/* The feature report that holds it. */
typedef struct CalibrationReport {
    uint8_t
        wake; /* a feature report to be read before: over Bluetooth reports are short until then; 0: none */
    uint8_t id;
    uint8_t size; /* bytes, the id among them; 0: this layout has no calibration */
} CalibrationReport;

CalibrationReport calibration_report(ReportLayout layout);

/* Parses such a report. False, and the nominal one, when id, length or (Bluetooth) checksum are wrong. An
   axis whose numbers make no sense (a scale that is not within a factor of two of the nominal one, a zero
   more than half a g away) is nominal. The gyro's bias is a part of its scale and is not subtracted from
   reports, as in the maker's own driver: what is left at rest is the business of who integrates. */
bool calibration_parse(ReportLayout layout, const uint8_t *bytes, size_t size, Calibration *out);

#endif
