/* The motion devices that are plugged in, or a recording that stands in for them: one thread of its own reads
   their reports, notices what comes and goes, and tells a listener. */
#ifndef SLOSH_DEVICES_H
#define SLOSH_DEVICES_H

#include "app/device/device_state.h"
#include "sim/error.h"

typedef enum DeviceEventKind {
    DEVICE_PLUGGED,   /* the state is all zero */
    DEVICE_REPORTED,  /* a valid report has come */
    DEVICE_UNPLUGGED, /* or it no longer answers */
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

/* Called on the thread of the devices, one call at a time; it must not block, nor call devices_stop. */
typedef void (*DeviceListener)(void *user, const DeviceEvent *event);

struct HidPort; /* device/hid_port.h: what reads bytes */

typedef struct DevicesSetup {
    const struct HidPort *port; /* NULL: hidapi */
    const char *source;         /* of --device: "file:PATH" replays a recording; NULL: what is plugged in */
    DeviceListener listener;
    void *user;
} DevicesSetup;

typedef struct Devices Devices;

/* NULL with the reason: the source is missing or no recording, no memory, no thread. Without any device it
   succeeds and waits for one. */
Devices *devices_start(const DevicesSetup *setup, Error *error);
void devices_stop(Devices *devices); /* NULL is allowed; no call of the listener comes after it */

#endif
