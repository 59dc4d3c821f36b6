/* Raw reports of motion devices with their times, in a file for replays (`--device file:PATH`), tests and bug
   reports. Text, one event per line, in the order of time:

     slosh device recording 1
     program 0.1
     0.000000 1 plugged dualsense 054c:0ce6 usb DualSense
     0.000000 1 calibration 05ff...            the feature report, id first; left out: nominal
     0.004012 1 report 017f80...               id first, in hexadecimal digits
     9.250000 1 unplugged

   A line begins with the time since the start, s, and the device's number: 1, 2, ... in the order of plugging
   in; a device plugged in again gets a new number. The name at the end of a line is for people. If a killed
   writer left an incomplete last line, the complete lines are read. */
#ifndef APP_INPUT_DEVICE_REPORT_LOG_H
#define APP_INPUT_DEVICE_REPORT_LOG_H

#include "app/input/device/device.h"

#include "slosh/error.h"

#include <stddef.h>

enum {
    REPORT_LOG_DEVICES_MAX = 64,
    REPORT_LOG_REPORT_MAX = 1024,    /* bytes of one report */
    REPORT_LOG_BYTES_MAX = 256 << 20 /* of a file: an hour of a DualSense over Bluetooth */
};

typedef enum ReportLogKind {
    REPORT_LOG_PLUGGED,
    REPORT_LOG_CALIBRATION,
    REPORT_LOG_REPORT,
    REPORT_LOG_UNPLUGGED
} ReportLogKind;

typedef struct ReportLogEntry {
    double time; /* s, never less than in the entry before */
    size_t offset;
    uint16_t size;  /* the report is bytes[offset], ...; 0: none */
    uint8_t kind;   /* ReportLogKind */
    uint8_t device; /* index into devices: number in the file less 1 */
} ReportLogEntry;

typedef struct ReportLogDevice {
    const DeviceRow *row;
    bool bluetooth;
    bool plugged; /* at the end */
} ReportLogDevice;

typedef struct ReportLog {
    ReportLogDevice devices[REPORT_LOG_DEVICES_MAX];
    int device_count;
    ReportLogEntry *entries;
    uint8_t *bytes;
    size_t count, capacity, byte_count, byte_capacity;
} ReportLog;

/* Parses the bytes of a file; pure. Returns false, with nothing to destroy, and "path:line: problem;
   advice". */
bool report_log_parse(const char *path, const char *bytes, size_t size, ReportLog *out, Error *error);
bool report_log_read(const char *path, ReportLog *out, Error *error);
void report_log_destroy(ReportLog *log); /* a zeroed one is allowed */

typedef struct ReportLogWriter ReportLogWriter;

/* Creates a new file; fails if the file exists, as nobody can repeat the recorded motion. Each line is
   written to the system at once, so that a killed program loses nothing. Returns NULL with the reason. */
ReportLogWriter *report_log_create(const char *path, Error *error);

/* Returns the number of the device plugged in; 0 if there are too many: its lines are left out. */
int report_log_plugged(ReportLogWriter *writer, const DeviceRow *row, bool bluetooth);

/* `number`: from report_log_plugged. `time`: of wall_ms, in s. Reports over REPORT_LOG_REPORT_MAX bytes
   are left out. */
void report_log_calibration(ReportLogWriter *writer, int number, const uint8_t *bytes, size_t size);
void report_log_report(ReportLogWriter *writer, int number, double time, const uint8_t *bytes, size_t size);
void report_log_unplugged(ReportLogWriter *writer, int number);

/* Returns true if a line could not be written: the disk is full. */
bool report_log_broken(const ReportLogWriter *writer);

/* Returns false with the reason if a line is missing. NULL is allowed. */
bool report_log_close(ReportLogWriter *writer, Error *error);

#endif
