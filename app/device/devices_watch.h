/* Shows what motion devices say: bars on a terminal, else a line a change. */
#ifndef SLOSH_DEVICES_WATCH_H
#define SLOSH_DEVICES_WATCH_H

#include "app/device/devices.h"
#include "app/device/report_log.h"

#include <stdio.h>

enum { WATCH_DEVICES_MAX = 32 };

/* One that was there. */
typedef struct WatchedDevice {
    int number;
    const DeviceRow *row;
    DeviceState state; /* the last */
    bool plugged;
    char problem[512]; /* why it may not be opened; "" */
} WatchedDevice;

typedef struct Watch {
    const char *source;      /* of --device, or NULL */
    ReportLogWriter *record; /* or NULL */
    FILE *out;               /* where values go; NULL: nowhere */
    FILE *messages;          /* what comes and goes; NULL: nowhere */
    bool bars;               /* out is a terminal */
    /* set at the end */
    int out_error; /* errno where out took no more; 0 */
    int count;
    WatchedDevice devices[WATCH_DEVICES_MAX];
} Watch;

/* Runs until a signal comes (app/base/interrupt.h), the recording has ended, `record` breaks or `out` takes
   no more. False with the reason: it could not begin. */
bool devices_watch(Watch *watch, Error *error);

#endif
