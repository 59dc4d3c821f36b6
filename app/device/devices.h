/* The plugged in motion devices, or a recording in their place: own threads read reports, notice plugged
   and unplugged devices, and call a listener. A recording is played once, at its recorded speed. At its
   end the remaining devices are unplugged, as if the cable were pulled: the box stays in place. */
#ifndef SLOSH_DEVICES_H
#define SLOSH_DEVICES_H

#include "app/device/device_state.h"
#include "sim/base/error.h"

typedef enum DeviceEventKind {
    DEVICE_PLUGGED,   /* the state is all zero */
    DEVICE_REPORTED,  /* a valid report has arrived */
    DEVICE_UNPLUGGED, /* or the device no longer answers; also for a refused device */
    DEVICE_REFUSED    /* the device may not be opened: `problem` has the reason and advice; once per plug */
} DeviceEventKind;

/* All pointers are valid only during the call. */
typedef struct DeviceEvent {
    DeviceEventKind kind;
    int number; /* of the device, from 1; a device plugged in again gets a new number */
    DeviceFamily family;
    uint16_t vendor, product;
    const char *name;         /* from device/device_table.h */
    const char *problem;      /* DEVICE_REFUSED; or "" */
    const DeviceState *state; /* after the report */
} DeviceEvent;

/* Called on a thread of the devices, one call at a time. Must not block or call devices_stop. */
typedef void (*DeviceListener)(void *user, const DeviceEvent *event);

struct HidPort;         /* device/hid_port.h: access to hardware */
struct ReportLog;       /* device/report_log.h */
struct ReportLogWriter; /* device/report_log.h */

typedef struct DevicesSetup {
    const struct HidPort *port; /* NULL: hidapi */
    const char *source;         /* of --device: "file:PATH" replays a recording; NULL: plugged in devices */
    DeviceListener listener;
    void *user;
    struct ReportLogWriter *record; /* NULL, or gets every raw report, valid or not, until devices_stop */
} DevicesSetup;

typedef struct Devices Devices;

/* Returns true if devices_start could use `source`; call before any other work. Returns false with the
   reason. */
bool devices_check(const char *source, Error *error);

/* Starts the threads. Returns NULL with the reason: source missing or no recording, no memory, no thread.
   Succeeds without any device, and waits for devices. Does not block: the listener is called for each
   device when ready. */
Devices *devices_start(const DevicesSetup *setup, Error *error);

/* Opens the recording named by setup->source, without thread and clock: devices_play_next calls the
   listener. End with devices_stop. Returns NULL with the reason. */
Devices *devices_open(const DevicesSetup *setup, Error *error);

/* Returns the time of a recording's next event, s; INFINITY at the end. The last event, at the time of the
   event before, unplugs the remaining devices. */
double devices_due(const Devices *devices);
void devices_play_next(
    Devices *devices); /* calls the listener for the next event, if any; invalid reports are skipped */
const struct ReportLog *devices_recording(const Devices *devices);
void devices_rewind(Devices *devices); /* to the start, without calling the listener */

/* Returns true if a recording has been played to its end. Callable from any thread. */
bool devices_ended(const Devices *devices);

/* Stops all threads; the listener is not called afterwards. NULL is allowed. Takes usually 0.1 s, at most
   half a second: a thread blocked by the system in a read is left to end later. */
void devices_stop(Devices *devices);

#endif
