/* Raw reports of motion devices with their times, as a file: to be replayed (`--device file:PATH`), tested
   with and sent with a bug report. Text, a line an event, in order of time:

     slosh device recording 1
     program 0.1
     0.000000 1 plugged dualsense 054c:0ce6 usb DualSense
     0.000000 1 calibration 05ff...            the feature report, id first; left out: nominal
     0.004012 1 report 017f80...               id first, in hexadecimal digits
     9.250000 1 unplugged

   Each begins with the time in s since the start and the number of the device: 1, 2, ... in the order in
   which they are plugged in; what is plugged in again gets a new one. The name at the end of a line is for
   people. A file that ends within a line, because its writer was killed, is read as far as it is whole. */
#ifndef SLOSH_REPORT_LOG_H
#define SLOSH_REPORT_LOG_H

#include "app/device/device_table.h"
#include "sim/base/error.h"

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
    double time; /* s, never less than that of the entry before */
    size_t offset;
    uint16_t size;  /* the report is bytes[offset], ...; 0: none */
    uint8_t kind;   /* ReportLogKind */
    uint8_t device; /* devices[device]: one less than its number in the file */
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

/* Reads the bytes of a file; pure. False, and nothing to destroy, with "path:line: what is wrong; what would
   be right". */
bool report_log_parse(const char *path, const char *bytes, size_t size, ReportLog *out, Error *error);
bool report_log_read(const char *path, ReportLog *out, Error *error);
void report_log_destroy(ReportLog *log); /* a zeroed one is allowed */

typedef struct ReportLogWriter ReportLogWriter;

/* Begins a new file; one that is there stays, for no hand does the same again. Each line is handed to the
   system at once, so that a killed program leaves all that came before. NULL with the reason. */
ReportLogWriter *report_log_create(const char *path, Error *error);

/* The number of the device that is plugged in now; 0 when there are too many: its lines are left out. */
int report_log_plugged(ReportLogWriter *writer, const DeviceRow *row, bool bluetooth);

/* `number` as from report_log_plugged. `time`: of wall_ms, in s. More than REPORT_LOG_REPORT_MAX bytes are
 * left out. */
void report_log_calibration(ReportLogWriter *writer, int number, const uint8_t *bytes, size_t size);
void report_log_report(ReportLogWriter *writer, int number, double time, const uint8_t *bytes, size_t size);
void report_log_unplugged(ReportLogWriter *writer, int number);

/* Whether a line could not be written: the disk is full. */
bool report_log_broken(const ReportLogWriter *writer);

/* False with the reason where a line is missing. NULL is allowed. */
bool report_log_close(ReportLogWriter *writer, Error *error);

#endif
