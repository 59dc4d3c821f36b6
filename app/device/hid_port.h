/* Interface of the device layer to the machine: a table of functions, replaceable in tests. `enumerate`
   and `open` are called by one thread, the rest by one thread per device. */
#ifndef SLOSH_HID_PORT_H
#define SLOSH_HID_PORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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
   files: device_trouble.h. */
extern const HidPort hid_port_hidapi;

#endif
