/* What the device layer asks of the machine: a table of functions, so that tests put a stand-in there.
   `enumerate` and `open` are called by one thread, the rest by one thread a device. */
#ifndef SLOSH_HID_PORT_H
#define SLOSH_HID_PORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { HID_PATH_SIZE = 256, HID_REASON_SIZE = 256 };

/* One place where reports come from. */
typedef struct HidInfo {
    char path[HID_PATH_SIZE];
    uint16_t vendor, product;
    bool bluetooth;
    uint16_t usage_page, usage; /* of the HID tables; 0: not known */
} HidInfo;

/* Why it was not opened. */
typedef enum HidRefusal {
    HID_DENIED, /* this user may not */
    HID_BUSY,   /* another program holds it */
    HID_FAILED  /* `reason` says it */
} HidRefusal;

typedef struct HidPort {
    void *self;  /* the first argument of `enumerate` and `open` */
    int look_ms; /* from one `enumerate` to the next: what is plugged in is noticed that soon */

    /* What is plugged in, at most `max`; the same path may come more than once. Returns their number, or -1
       when that cannot be told now. */
    int (*enumerate)(void *self, HidInfo *out, int max);

    /* A handle; NULL with the two last set. */
    void *(*open)(void *self, const char *path, HidRefusal *why, char reason[HID_REASON_SIZE]);

    /* Waits for a report, id first. Returns its length, 0 when none has come in time, less when the device
       is gone. */
    int (*read)(void *handle, uint8_t *bytes, size_t size, int timeout_ms);

    /* bytes[0] is the id of a feature report, which is read there, id first. Returns its length, or less
       than 0. */
    int (*get_feature)(void *handle, uint8_t *bytes, size_t size);

    void (*close)(void *handle);
} HidPort;

/* hidapi over hidraw, which leaves the kernel's driver in place. Needs the device files to be readable and
   writable: device_trouble.h. */
extern const HidPort hid_port_hidapi;

#endif
