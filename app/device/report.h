/* Parses the bytes of a report into a device's state: pure, no I/O. */
#ifndef SLOSH_REPORT_H
#define SLOSH_REPORT_H

#include "app/device/calibration.h"

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
