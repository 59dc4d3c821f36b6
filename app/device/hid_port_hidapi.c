#include "app/device/hid_port.h"

#include <errno.h>
#include <fcntl.h>
#include <hidapi.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static int enumerate(void *self, HidInfo *out, int max)
{
    (void)self;
    int count = 0;
    struct hid_device_info *list = hid_enumerate(0, 0);
    for (const struct hid_device_info *info = list; info && count < max; info = info->next) {
        if (!info->path || strlen(info->path) >= HID_PATH_SIZE)
            continue;
        HidInfo *place = &out[count++];
        *place = (HidInfo){.vendor = info->vendor_id,
                           .product = info->product_id,
                           .bluetooth = info->bus_type == HID_API_BUS_BLUETOOTH,
                           .usage_page = info->usage_page,
                           .usage = info->usage};
        snprintf(place->path, sizeof place->path, "%s", info->path);
    }
    hid_free_enumeration(list);
    return count;
}

/* hidapi reports failures only as text: finds the reason by opening the file. */
static void explain(const char *path, HidRefusal *why, char reason[HID_REASON_SIZE])
{
    const wchar_t *words = hid_error(NULL);
    snprintf(reason, HID_REASON_SIZE, "%ls", words ? words : L"it does not open");
    const int file = open(path, O_RDWR | O_CLOEXEC);
    const int number = errno;
    if (file >= 0)
        close(file);
    *why = file >= 0                             ? HID_FAILED
           : number == EACCES || number == EPERM ? HID_DENIED
           : number == EBUSY                     ? HID_BUSY
                                                 : HID_FAILED;
}

static void *open_path(void *self, const char *path, HidRefusal *why, char reason[HID_REASON_SIZE])
{
    (void)self;
    hid_device *device = hid_open_path(path);
    if (!device)
        explain(path, why, reason);
    return device;
}

static int read_report(void *handle, uint8_t *bytes, size_t size, int timeout_ms)
{
    return hid_read_timeout(handle, bytes, size, timeout_ms);
}

static int get_feature(void *handle, uint8_t *bytes, size_t size)
{
    return hid_get_feature_report(handle, bytes, size);
}

static void close_device(void *handle)
{
    hid_close(handle);
}

const HidPort hid_port_hidapi = {.look_ms = 1000,
                                 .enumerate = enumerate,
                                 .open = open_path,
                                 .read = read_report,
                                 .get_feature = get_feature,
                                 .close = close_device};
