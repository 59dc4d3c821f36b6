/* The plugged in motion devices, or a recording in their place: own threads read reports, notice plugged
   and unplugged devices, and call a listener. A recording is played once, at its recorded speed. At its
   end the remaining devices are unplugged, as if the cable were pulled: the box stays in place. */
#ifndef APP_INPUT_DEVICE_DEVICES_H
#define APP_INPUT_DEVICE_DEVICES_H

#include "app/input/device/device.h"

#include "app/input/device/report_log.h"
#include "slosh/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

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
    const char *name;         /* of device_rows */
    const char *problem;      /* DEVICE_REFUSED; or "" */
    const DeviceState *state; /* after the report */
} DeviceEvent;

/* Called on a thread of the devices, one call at a time. Must not block or call devices_stop. */
typedef void (*DeviceListener)(void *user, const DeviceEvent *event);

struct HidPort; /* below: access to hardware */

typedef struct DevicesSetup {
    const struct HidPort *port; /* NULL: hidapi */
    const char *source;         /* of --device: "file:PATH" replays a recording; NULL: plugged in devices */
    DeviceListener listener;
    void *user;
    ReportLogWriter *record; /* NULL, or gets every raw report, valid or not, until devices_stop */
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
const ReportLog *devices_recording(const Devices *devices);
void devices_rewind(Devices *devices); /* to the start, without calling the listener */

/* Returns true if a recording has been played to its end. Callable from any thread. */
bool devices_ended(const Devices *devices);

/* Stops all threads; the listener is not called afterwards. NULL is allowed. Takes usually 0.1 s, at most
   half a second: a thread blocked by the system in a read is left to end later. */
void devices_stop(Devices *devices);

/* Interface of the device layer to the machine: a table of functions, replaceable in tests. `enumerate`
   and `open` are called by one thread, the rest by one thread per device. */

enum { HID_PATH_SIZE = 256, HID_REASON_SIZE = 256 };

/* A HID interface. */
typedef struct HidInfo {
    char path[HID_PATH_SIZE];
    uint16_t vendor, product;
    bool bluetooth;
    uint16_t usage_page, usage; /* of the HID tables; 0: unknown */
} HidInfo;

/* Why a device was not opened. */
typedef enum HidRefusal {
    HID_DENIED, /* no permission */
    HID_BUSY,   /* used exclusively by another program */
    HID_FAILED  /* see `reason` */
} HidRefusal;

typedef struct HidPort {
    void *self;  /* the first argument of `enumerate` and `open` */
    int look_ms; /* interval of `enumerate`, the delay in noticing a new device */

    /* Lists at most `max` plugged in interfaces; a path may occur more than once. Returns the count, or -1
       on failure. */
    int (*enumerate)(void *self, HidInfo *out, int max);

    /* Returns a handle, or NULL with *why and `reason` set. */
    void *(*open)(void *self, const char *path, HidRefusal *why, char reason[HID_REASON_SIZE]);

    /* Waits for a report, id first. Returns its length, 0 after the timeout, less than 0 if the device is
       gone. */
    int (*read)(void *handle, uint8_t *bytes, size_t size, int timeout_ms);

    /* Reads the feature report with the id bytes[0] into `bytes`, id first. Returns its length, or less
       than 0. */
    int (*get_feature)(void *handle, uint8_t *bytes, size_t size);

    void (*close)(void *handle);
} HidPort;

/* hidapi over hidraw, which leaves the kernel's driver in place. Needs read and write access to the device
   files: device_problem. */
extern const HidPort hid_port_hidapi;

/* Explains why a device may not be opened, with advice. */

enum { DEVICE_PROBLEM_SIZE = 512, DEVICE_COMMAND_SIZE = 384 };

/* Makes the one command that lets users of this machine open the devices: installs tools/70-slosh.rules,
   or applies an installed rule to plugged in devices. Returns false if the rule did not come with the
   program. */
bool device_rules_command(char command[DEVICE_COMMAND_SIZE]);

/* Returns the row of a found device; NULL if not a motion device. A controller may have several HID
   interfaces: a mouse or keyboard inside is not a motion device. */
const DeviceRow *device_match(const HidInfo *info);

/* Describes why a device was not opened. `reason`: text from the port. */
void device_problem(const DeviceRow *row, HidRefusal why, const char *reason,
                    char problem[DEVICE_PROBLEM_SIZE]);

/* Adds a note for a device that may be opened: spacenavd also reads the device. Usually "". */
void device_note(const DeviceRow *row, char note[DEVICE_PROBLEM_SIZE]);

/* Returns the id of a process by name in `folder` ("/proc"); 0: none. */
long device_process(const char *folder, const char *name);

/* Lists the plugged in devices, and tests if they may be opened: a single look, without threads. */

enum { DEVICE_LIST_MAX = 64 };

typedef struct DeviceListing {
    HidInfo info;
    const DeviceRow *row;
    char problem[DEVICE_PROBLEM_SIZE]; /* "": may be opened */
} DeviceListing;

/* Opens and closes each known device. Returns the count of devices, at most DEVICE_LIST_MAX; -1 if
   enumeration fails. */
int device_list(const HidPort *port, DeviceListing out[DEVICE_LIST_MAX]);

/* Shows the values of motion devices: bars on a terminal, else one line per change. */

enum { WATCH_DEVICES_MAX = 32 };

/* A present or past device. */
typedef struct WatchedDevice {
    int number;
    const DeviceRow *row;
    DeviceState state; /* the last */
    bool plugged;
    char problem[512]; /* why the device may not be opened; or "" */
} WatchedDevice;

typedef struct DevicesWatch {
    const char *source;      /* of --device, or NULL */
    ReportLogWriter *record; /* or NULL */
    FILE *out;               /* for values; NULL: not shown */
    FILE *messages;          /* for plugged and unplugged devices; NULL: not shown */
    bool bars;               /* out is a terminal */
    /* set at the end */
    int out_error; /* errno of a failed write to out; or 0 */
    int count;
    WatchedDevice devices[WATCH_DEVICES_MAX];
} DevicesWatch;

/* Runs until a signal (app/base/program.h), the end of the recording, a failure of `record`, or a failed
   write to `out`. Returns false with the reason if it could not begin. */
bool devices_watch(DevicesWatch *watch, Error *error);

#endif
