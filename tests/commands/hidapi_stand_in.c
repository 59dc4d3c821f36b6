/* A stand-in for hidapi, preloaded into the program by test_devices.py. The file named by SLOSH_TEST_HID
   lists the plugged devices, a line a device: VENDOR PRODUCT usb|bluetooth PATH ready|denied|busy|broken
   REPORT. A ready device sends the report, in hexadecimal digits, every 10 ms, until the line is gone. */
#include <errno.h>
#include <fcntl.h>
#include <hidapi.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

typedef struct Line {
    unsigned vendor, product;
    char bus[16], path[64], state[16], report[256];
} Line;

static bool next_line(FILE *file, Line *line)
{
    return fscanf(file, "%x %x %15s %63s %15s %255s", &line->vendor, &line->product, line->bus, line->path,
                  line->state, line->report) == 6;
}

static bool find_line(const char *path, Line *line)
{
    bool found = false;
    const char *name = getenv("SLOSH_TEST_HID");
    FILE *file = name ? fopen(name, "r") : NULL;
    while (file && !found && next_line(file, line))
        found = strcmp(line->path, path) == 0;
    if (file)
        fclose(file);
    return found;
}

struct hid_device_info *hid_enumerate(unsigned short vendor, unsigned short product)
{
    struct hid_device_info *list = NULL, **end = &list;
    const char *name = getenv("SLOSH_TEST_HID");
    FILE *file = name ? fopen(name, "r") : NULL;
    Line line;
    (void)vendor;
    (void)product;
    while (file && next_line(file, &line)) {
        struct hid_device_info *info = calloc(1, sizeof *info);
        *end = info;
        end = &info->next;
        info->path = strdup(line.path);
        info->vendor_id = (unsigned short)line.vendor;
        info->product_id = (unsigned short)line.product;
        info->bus_type = strcmp(line.bus, "usb") == 0 ? HID_API_BUS_USB : HID_API_BUS_BLUETOOTH;
    }
    if (file)
        fclose(file);
    return list;
}

void hid_free_enumeration(struct hid_device_info *list)
{
    while (list) {
        struct hid_device_info *next = list->next;
        free(list->path);
        free(list);
        list = next;
    }
}

hid_device *hid_open_path(const char *path)
{
    Line line;
    return find_line(path, &line) && strcmp(line.state, "ready") == 0 ? (hid_device *)strdup(path) : NULL;
}

void hid_close(hid_device *device)
{
    free(device);
}

const wchar_t *hid_error(hid_device *device)
{
    (void)device;
    return L"the stand-in does not open it";
}

int hid_get_feature_report(hid_device *device, unsigned char *data, size_t length)
{
    (void)device;
    (void)data;
    (void)length;
    return -1;
}

int hid_read_timeout(hid_device *device, unsigned char *data, size_t length, int milliseconds)
{
    Line line;
    size_t size = 0;
    unsigned byte;
    (void)milliseconds;
    nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    if (!find_line((const char *)device, &line))
        return -1;
    while (size < length && sscanf(line.report + 2 * size, "%2x", &byte) == 1)
        data[size++] = (unsigned char)byte;
    return (int)size;
}

/* The device files, for the program's question about permissions. */
int open(const char *path, int flags, ...)
{
    Line line;
    va_list arguments;
    va_start(arguments, flags);
    const int mode = flags & (O_CREAT | __O_TMPFILE) ? va_arg(arguments, int) : 0;
    va_end(arguments);
    if (strncmp(path, "/dev/stand-in", 13) != 0)
        return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
    errno = ENOENT;
    if (find_line(path, &line))
        errno = strcmp(line.state, "denied") == 0 ? EACCES : strcmp(line.state, "busy") == 0 ? EBUSY : EIO;
    return -1;
}
