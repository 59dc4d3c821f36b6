/* The motion devices that are plugged in, or a recording that stands in for them: threads of their own read
   their reports, notice what comes and goes, and tell a listener. A recording is played once, as fast as it
   was recorded; at its end, what is still plugged in is unplugged, as if the cable were drawn: what it moved
   stays where it is. */
#ifndef SLOSH_DEVICES_H
#define SLOSH_DEVICES_H

#include "app/device/device_state.h"
#include "sim/base/error.h"

typedef enum DeviceEventKind {
    DEVICE_PLUGGED,   /* the state is all zero */
    DEVICE_REPORTED,  /* a valid report has come */
    DEVICE_UNPLUGGED, /* or it no longer answers; a refused one too */
    DEVICE_REFUSED /* it is there and may not be opened: `problem` says why and what would help; once a plug
                    */
} DeviceEventKind;

/* Everything in it is valid during the call only. */
typedef struct DeviceEvent {
    DeviceEventKind kind;
    int number; /* of the device, from 1 on; what is plugged in again gets a new one */
    DeviceFamily family;
    uint16_t vendor, product;
    const char *name;         /* as device/device_table.h has it */
    const char *problem;      /* DEVICE_REFUSED; or "" */
    const DeviceState *state; /* after the report */
} DeviceEvent;

/* Called on a thread of the devices, one call at a time; it must not block, nor call devices_stop. */
typedef void (*DeviceListener)(void *user, const DeviceEvent *event);

struct HidPort;         /* device/hid_port.h: what reads bytes */
struct ReportLog;       /* device/report_log.h */
struct ReportLogWriter; /* the same */

typedef struct DevicesSetup {
    const struct HidPort *port; /* NULL: hidapi */
    const char *source;         /* of --device: "file:PATH" replays a recording; NULL: what is plugged in */
    DeviceListener listener;
    void *user;
    struct ReportLogWriter
        *record; /* NULL, or where every raw report goes, valid or not, until devices_stop */
} DevicesSetup;

typedef struct Devices Devices;

/* Whether devices_start could take `source`: before anything else is begun. False with the reason. */
bool devices_check(const char *source, Error *error);

/* NULL with the reason: the source is missing or no recording, no memory, no thread. Without any device it
   succeeds and waits for one. It does not wait for the devices: each is told to the listener when it is
   ready. */
Devices *devices_start(const DevicesSetup *setup, Error *error);

/* The recording that setup->source names, in a time that the caller keeps: no thread and no clock. The
   listener is called by devices_play_next. To be ended by devices_stop; NULL with the reason. */
Devices *devices_open(const DevicesSetup *setup, Error *error);

/* Of such: the time of the next event, s; INFINITY when all has been told. The last event, at the time of the
   one before, unplugs what is still plugged in. */
double devices_due(const Devices *devices);
void devices_play_next(
    Devices *devices); /* tells it, if there is one; a report that is not valid is not told */
const struct ReportLog *devices_recording(const Devices *devices);
void devices_rewind(Devices *devices); /* to the start, without a word to the listener */

/* Whether a recording has been played to its end, and all has been told. Any thread may ask. */
bool devices_ended(const Devices *devices);

/* NULL is allowed; no call of the listener comes after it. Takes 0.1 s as a rule, and at most half a second:
   a thread that the system holds in a read is left to end by itself. */
void devices_stop(Devices *devices);

#endif
