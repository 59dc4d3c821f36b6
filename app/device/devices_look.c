#include "app/device/devices_state.h"

#include "sim/base/stage.h"

#include <stdlib.h>
#include <string.h>

enum {
    INFOS_MAX = 256,
    READ_MS = 100,         /* timeout of a read: the longest delay of a stop */
    NAP_MS = 10,           /* wait after a read that returned at once without report */
    CALIBRATION_TRIES = 3, /* Bluetooth may damage a report */
    DENIALS_TOLD = 2       /* udev sets access rights shortly after a device appears */
};

static bool feature(const Device *device, uint8_t id, uint8_t bytes[CALIBRATION_BYTES_MAX], int *size)
{
    memset(bytes, 0, CALIBRATION_BYTES_MAX);
    bytes[0] = id;
    *size = device->devices->port.get_feature(device->handle, bytes, CALIBRATION_BYTES_MAX);
    return *size > 0 && *size <= CALIBRATION_BYTES_MAX;
}

/* Reads the device's own calibration; also switches a device with short reports to full reports. Returns
   the count of bytes; 0: none, and a nominal calibration is used. Call without the lock, as reading may
   take a while. */
static size_t read_calibration(const Device *device, uint8_t bytes[CALIBRATION_BYTES_MAX],
                               Calibration *calibration)
{
    const CalibrationReport report = calibration_report(device->format.layout);
    int size = 0;
    *calibration = calibration_nominal();
    if (report.wake)
        feature(device, report.wake, bytes, &size);
    for (int i = 0; report.size && i < CALIBRATION_TRIES; i++)
        if (feature(device, report.id, bytes, &size) &&
            calibration_parse(device->format.layout, bytes, (size_t)size, calibration))
            return (size_t)size;
    return 0;
}

/* Calibrates a device, and reports it as plugged in. */
static void introduce(Device *device)
{
    Devices *devices = device->devices;
    uint8_t bytes[CALIBRATION_BYTES_MAX];
    Calibration calibration;
    const size_t size = read_calibration(device, bytes, &calibration);
    pthread_mutex_lock(&devices->lock);
    device->format.calibration = calibration;
    if (!device->gone) {
        devices_plugged(device);
        if (devices->setup.record && !devices->stopping)
            report_log_calibration(devices->setup.record, device->log_number, bytes, size);
    }
    pthread_mutex_unlock(&devices->lock);
}

/* Forwards a report. Returns true if the thread must go on. */
static bool take_report(Device *device, const uint8_t *bytes, int size, double time)
{
    Devices *devices = device->devices;
    pthread_mutex_lock(&devices->lock);
    const bool lies = size > REPORT_BYTES_MAX;
    if (size > 0 && !device->gone)
        devices_reported(device, bytes, lies ? 0 : (size_t)size, time);
    if (size == 0 && wall_ms() - 1000 * time < NAP_MS)
        devices_wait(devices, wall_ms() + NAP_MS);
    const bool on = size >= 0 && !device->gone && !devices->stopping;
    pthread_mutex_unlock(&devices->lock);
    return on;
}

/* Thread of one device: each report goes from the read to the listener without waiting. */
static void *read_device(void *data)
{
    Device *device = data;
    Devices *devices = device->devices;
    uint8_t bytes[REPORT_BYTES_MAX];
    bool on = true;
    introduce(device);
    while (on) {
        const double before = wall_ms();
        const int size = devices->port.read(device->handle, bytes, sizeof bytes, READ_MS);
        on = take_report(device, bytes, size, (size == 0 ? before : wall_ms()) / 1000);
    }
    devices->port.close(device->handle);
    pthread_mutex_lock(&devices->lock);
    if (!device->gone)
        devices_unplugged(device);
    device->gone = true;
    pthread_mutex_unlock(&devices->lock);
    devices_finish(devices, &device->ended);
    return NULL;
}

static Device *find(const Devices *devices, const char *path)
{
    Device *device = devices->list;
    while (device && (device->gone || strcmp(device->path, path) != 0))
        device = device->next;
    return device;
}

static Device *add(Devices *devices, const HidInfo *info, const DeviceRow *row)
{
    Device *device = calloc(1, sizeof *device);
    if (!device)
        return NULL;
    device->devices = devices;
    device->number = ++devices->numbers;
    device->bluetooth = info->bluetooth;
    device->format = (ReportFormat){.row = row, .layout = info->bluetooth ? row->bluetooth : row->usb};
    memcpy(device->path, info->path, sizeof device->path);
    device->next = devices->list;
    devices->list = device;
    return device;
}

/* Opens a device, with the lock released, and starts its thread. */
static void try_open(Device *device, bool first_look)
{
    Devices *devices = device->devices;
    char problem[DEVICE_PROBLEM_SIZE], reason[HID_REASON_SIZE] = "";
    HidRefusal why = HID_FAILED;
    pthread_mutex_unlock(&devices->lock);
    device->handle = devices->port.open(devices->port.self, device->path, &why, reason);
    pthread_mutex_lock(&devices->lock);
    if (device->handle) {
        device->began = !devices->stopping && devices_spawn(devices, &device->thread, read_device, device);
        if (!device->began) {
            devices->port.close(device->handle);
            device->handle = NULL;
        }
        return;
    }
    const bool told = device->denials >= DENIALS_TOLD;
    device->denials = first_look ? DENIALS_TOLD : device->denials + 1;
    if (told || device->denials < DENIALS_TOLD)
        return;
    device_trouble(device->format.row, why, reason, problem);
    devices_tell(device, DEVICE_REFUSED, problem);
}

/* Reports a device as unplugged, even if its thread has not noticed yet. */
static void lose(Device *device)
{
    if (!device->gone && device->plugged)
        devices_unplugged(device);
    else if (!device->gone && device->denials >= DENIALS_TOLD)
        devices_tell(device, DEVICE_UNPLUGGED, "");
    device->gone = true;
}

/* Removes unplugged devices whose thread has ended, or that never had a thread. */
static void drop_gone(Devices *devices)
{
    for (Device **place = &devices->list; *place;) {
        Device *device = *place;
        if (!device->gone || (device->began && !device->ended)) {
            place = &device->next;
            continue;
        }
        *place = device->next;
        if (device->began)
            pthread_join(device->thread, NULL);
        free(device);
    }
}

static void take_look(Devices *devices, const HidInfo *infos, int count, bool first)
{
    for (Device *device = devices->list; device; device = device->next)
        device->seen = false;
    for (int i = 0; i < count && !devices->stopping; i++) {
        const DeviceRow *row = device_match(&infos[i]);
        Device *device = row ? find(devices, infos[i].path) : NULL;
        if (device && device->format.row != row) { /* another device has the path now */
            lose(device);
            device = NULL;
        }
        device = row && !device ? add(devices, &infos[i], row) : device;
        if (device && !device->handle && !device->seen)
            try_open(device, first);
        if (device)
            device->seen = true;
    }
    for (Device *device = devices->list; device; device = device->next)
        if (!device->seen)
            lose(device);
    drop_gone(devices);
}

void *devices_look(void *data)
{
    Devices *devices = data;
    HidInfo *infos = malloc(INFOS_MAX * sizeof *infos);
    bool first = true;
    pthread_mutex_lock(&devices->lock);
    while (infos && !devices->stopping) {
        pthread_mutex_unlock(&devices->lock);
        const int count = devices->port.enumerate(devices->port.self, infos, INFOS_MAX);
        pthread_mutex_lock(&devices->lock);
        if (count >= 0 && count <= INFOS_MAX && !devices->stopping)
            take_look(devices, infos, count, first);
        first = false;
        devices_wait(devices, wall_ms() + devices->port.look_ms);
    }
    pthread_mutex_unlock(&devices->lock);
    free(infos);
    devices_finish(devices, &devices->ended);
    return NULL;
}
