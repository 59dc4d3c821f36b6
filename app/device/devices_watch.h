/* Shows the values of motion devices: bars on a terminal, else one line per change. */
#ifndef SLOSH_DEVICES_WATCH_H
#define SLOSH_DEVICES_WATCH_H

#include "app/device/devices.h"
#include "app/device/report_log.h"

#include <stdio.h>

enum { WATCH_DEVICES_MAX = 32 };

/* A present or past device. */
typedef struct WatchedDevice {
    int number;
    const DeviceRow *row;
    DeviceState state; /* the last */
    bool plugged;
    char problem[512]; /* why the device may not be opened; or "" */
} WatchedDevice;

typedef struct Watch {
    const char *source;      /* of --device, or NULL */
    ReportLogWriter *record; /* or NULL */
    FILE *out;               /* for values; NULL: not shown */
    FILE *messages;          /* for plugged and unplugged devices; NULL: not shown */
    bool bars;               /* out is a terminal */
    /* set at the end */
    int out_error; /* errno of a failed write to out; or 0 */
    int count;
    WatchedDevice devices[WATCH_DEVICES_MAX];
} Watch;

/* Runs until a signal (app/base/program.h), the end of the recording, a failure of `record`, or a failed
   write to `out`. Returns false with the reason if it could not begin. */
bool devices_watch(Watch *watch, Error *error);

#endif
