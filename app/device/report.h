/* From the bytes of a report to the state of a device: pure, no I/O. */
#ifndef SLOSH_REPORT_H
#define SLOSH_REPORT_H

#include "app/device/calibration.h"

/* More than any report of a layout has; longer ones, of audio, are cut to this and refused. */
enum { REPORT_BYTES_MAX = 128 };

/* What is needed to read the reports of one device. */
typedef struct ReportFormat {
    const DeviceRow *row;
    ReportLayout layout; /* row->usb or row->bluetooth */
    Calibration calibration;
} ReportFormat;

/* Reads one report, `bytes` with its id first, at `time` (s). True: `state` is what it says; what the report
   has nothing about stays. False when id, length or checksum are not of the layout: nothing but
   state->refused is changed. */
bool report_parse(const ReportFormat *format, const uint8_t *bytes, size_t size, double time,
                  DeviceState *state);

#endif
