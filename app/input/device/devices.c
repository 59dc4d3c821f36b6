/* The threads that read, look for and replay devices. */
#include "app/input/device/device.h"

#include "app/input/device/report.h"
#include "sim/world.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* A present or past device: replayed, or read by its own thread. */
typedef struct Device {
    struct Device *next;
    struct Devices *devices;
    int number, log_number; /* number for the listener; number in the recorded file, 0: none */
    ReportFormat format;
    bool bluetooth;
    DeviceState state;
    bool plugged; /* reported as plugged in, and not yet as unplugged */
    /* only for real devices: */
    char path[HID_PATH_SIZE];
    void *handle;      /* NULL: not opened; else used by the thread */
    int denials;       /* count of failed attempts to open */
    bool seen;         /* at the last look */
    bool gone;         /* the thread must end and report nothing more */
    bool began, ended; /* state of the thread */
    pthread_t thread;
} Device;

struct Devices {
    DevicesSetup setup;
    HidPort port;
    ReportLog log;        /* the replayed recording */
    Device *replayed;     /* REPORT_LOG_DEVICES_MAX entries; NULL: no replay */
    size_t next;          /* next entry of `log`; its count: unplug the rest; greater: finished */
    pthread_mutex_t lock; /* guards all members below and the devices; held during calls of the listener */
    pthread_cond_t wake;  /* signalled on stop, or at the end of a thread */
    bool stopping;
    bool left; /* devices_stop has returned before all threads ended: the last thread frees everything */
    int threads, numbers;
    Device *list;
    bool began, ended; /* of the thread for looking or replaying */
    pthread_t thread;
    atomic_bool played;
};

/* Call all with the lock held. The listener is not called once stopping is set. */
static void devices_notify(Device *device, DeviceEventKind kind, const char *problem);
static void devices_plugged(Device *device);
static void devices_reported(Device *device, const uint8_t *bytes, size_t size, double time);
static void devices_unplugged(Device *device);

/* Waits until a time of wall_ms, or until stopping. */
static void devices_wait(Devices *devices, double until_ms);

/* devices_spawn starts a thread. The thread ends with devices_finish, which takes the lock, marks *ended,
   and frees everything after the last thread if devices_stop has returned. */
static bool devices_spawn(Devices *devices, pthread_t *thread, void *(*run)(void *), void *data);
static void devices_finish(Devices *devices, bool *ended);

static void plug_in(Devices *devices, const ReportLogDevice *logged, Device *device)
{
    const DeviceRow *row = logged->row;
    *device = (Device){.devices = devices,
                       .number = ++devices->numbers,
                       .bluetooth = logged->bluetooth,
                       .format = {.row = row, .layout = logged->bluetooth ? row->bluetooth : row->usb}};
    device->format.calibration = calibration_nominal();
    devices_plugged(device);
}

static void calibrate(Device *device, const uint8_t *bytes, size_t size)
{
    calibration_parse(device->format.layout, bytes, size, &device->format.calibration);
    if (device->devices->setup.record && !device->devices->stopping)
        report_log_calibration(device->devices->setup.record, device->log_number, bytes, size);
}

static void play(Devices *devices, const ReportLogEntry *entry, Device *device)
{
    const uint8_t *bytes = entry->size > 0 ? devices->log.bytes + entry->offset : NULL;
    switch ((ReportLogKind)entry->kind) {
    case REPORT_LOG_PLUGGED:
        plug_in(devices, &devices->log.devices[entry->device], device);
        break;
    case REPORT_LOG_CALIBRATION:
        calibrate(device, bytes, entry->size);
        break;
    case REPORT_LOG_REPORT:
        devices_reported(device, bytes, entry->size, entry->time);
        break;
    case REPORT_LOG_UNPLUGGED:
        devices_unplugged(device);
        break;
    }
}

double devices_due(const Devices *devices)
{
    const ReportLog *log = &devices->log;
    if (devices->next > log->count)
        return INFINITY;
    const size_t at = devices->next < log->count ? devices->next : log->count - 1;
    return log->count ? log->entries[at].time : 0;
}

void devices_play_next(Devices *devices)
{
    const ReportLog *log = &devices->log;
    if (devices->next < log->count) {
        const ReportLogEntry *entry = &log->entries[devices->next];
        play(devices, entry, &devices->replayed[entry->device]);
    }
    for (int k = 0; k < log->device_count && devices->next == log->count; k++)
        devices_unplugged(&devices->replayed[k]);
    devices->next += devices->next <= log->count;
}

const ReportLog *devices_recording(const Devices *devices)
{
    return &devices->log;
}

void devices_rewind(Devices *devices)
{
    devices->next = 0;
    devices->numbers = 0;
    for (int k = 0; k < REPORT_LOG_DEVICES_MAX; k++)
        devices->replayed[k] = (Device){.devices = devices};
}

/* Plays each event at its time; a late event is played as soon as possible, none is left out. */
static void play_all(Devices *devices)
{
    const double start = wall_ms();
    for (double due; (due = devices_due(devices)) < INFINITY && !devices->stopping;) {
        devices_wait(devices, start + 1000 * due);
        devices_play_next(devices);
    }
}

static void *devices_replay(void *data)
{
    Devices *devices = data;
    pthread_mutex_lock(&devices->lock);
    play_all(devices);
    pthread_mutex_unlock(&devices->lock);
    atomic_store(&devices->played, true);
    devices_finish(devices, &devices->ended);
    return NULL;
}

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
    const bool reported = device->denials >= DENIALS_TOLD;
    device->denials = first_look ? DENIALS_TOLD : device->denials + 1;
    if (reported || device->denials < DENIALS_TOLD)
        return;
    device_problem(device->format.row, why, reason, problem);
    devices_notify(device, DEVICE_REFUSED, problem);
}

/* Reports a device as unplugged, even if its thread has not noticed yet. */
static void lose(Device *device)
{
    if (!device->gone && device->plugged)
        devices_unplugged(device);
    else if (!device->gone && device->denials >= DENIALS_TOLD)
        devices_notify(device, DEVICE_UNPLUGGED, "");
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

static void *devices_scan(void *data)
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

static const double stop_patience_ms = 500;

/* Returns the part of "file:PATH" after the colon. */
static const char *source_path(const char *source, Error *error)
{
    static const char prefix[] = "file:";
    if (strncmp(source, prefix, sizeof prefix - 1) == 0 && source[sizeof prefix - 1])
        return source + sizeof prefix - 1;
    error_set(error, "device '%.200s' is unknown; write file:PATH, with the path of a recording", source);
    return NULL;
}

static bool read_source(const char *source, ReportLog *log, Error *error)
{
    const char *path = source_path(source, error);
    return path && report_log_read(path, log, error);
}

bool devices_check(const char *source, Error *error)
{
    ReportLog log = {0};
    const bool ok = read_source(source, &log, error);
    report_log_destroy(&log);
    return ok;
}

static void devices_notify(Device *device, DeviceEventKind kind, const char *problem)
{
    const DeviceRow *row = device->format.row;
    const DevicesSetup *setup = &device->devices->setup;
    if (device->devices->stopping)
        return;
    const DeviceEvent event = {.kind = kind,
                               .number = device->number,
                               .family = row->family,
                               .vendor = row->vendor,
                               .product = row->product,
                               .name = row->name,
                               .problem = problem,
                               .state = &device->state};
    if (setup->listener)
        setup->listener(setup->user, &event);
}

static void devices_plugged(Device *device)
{
    Devices *devices = device->devices;
    if (devices->stopping)
        return;
    device->plugged = true;
    if (devices->setup.record)
        device->log_number = report_log_plugged(devices->setup.record, device->format.row, device->bluetooth);
    devices_notify(device, DEVICE_PLUGGED, "");
}

static void devices_reported(Device *device, const uint8_t *bytes, size_t size, double time)
{
    Devices *devices = device->devices;
    const double now = wall_ms() / 1000;
    if (devices->stopping || !device->plugged)
        return;
    if (report_parse(&device->format, bytes, size, time, &device->state))
        devices_notify(device, DEVICE_REPORTED, "");
    if (devices->setup.record)
        report_log_report(devices->setup.record, device->log_number, now, bytes, size);
}

static void devices_unplugged(Device *device)
{
    Devices *devices = device->devices;
    if (devices->stopping || !device->plugged)
        return;
    device->plugged = false;
    devices_notify(device, DEVICE_UNPLUGGED, "");
    if (devices->setup.record)
        report_log_unplugged(devices->setup.record, device->log_number);
}

static void wait_for_wake(Devices *devices, double until_ms)
{
    /* wall_ms is CLOCK_MONOTONIC, like the condition's clock */
    const double second = floor(until_ms / 1000);
    const struct timespec until = {.tv_sec = (time_t)second,
                                   .tv_nsec = (long)((until_ms / 1000 - second) * 1e9)};
    pthread_cond_timedwait(&devices->wake, &devices->lock, &until);
}

static void devices_wait(Devices *devices, double until_ms)
{
    while (!devices->stopping && wall_ms() < until_ms)
        wait_for_wake(devices, until_ms);
}

static void free_devices(Devices *devices)
{
    for (Device *next, *device = devices->list; device; device = next) {
        next = device->next;
        free(device);
    }
    report_log_destroy(&devices->log);
    free(devices->replayed);
    pthread_cond_destroy(&devices->wake);
    pthread_mutex_destroy(&devices->lock);
    free(devices);
}

static bool devices_spawn(Devices *devices, pthread_t *thread, void *(*run)(void *), void *data)
{
    devices->threads++;
    if (pthread_create(thread, NULL, run, data) == 0)
        return true;
    devices->threads--;
    return false;
}

static void devices_finish(Devices *devices, bool *ended)
{
    pthread_mutex_lock(&devices->lock);
    *ended = true;
    const bool last = --devices->threads == 0 && devices->left;
    pthread_cond_broadcast(&devices->wake);
    pthread_mutex_unlock(&devices->lock);
    if (last)
        free_devices(devices);
}

static Devices *create(const DevicesSetup *setup, Error *error)
{
    pthread_condattr_t attributes;
    Devices *devices = calloc(1, sizeof *devices);
    if (!devices) {
        error_set(error, "no memory for motion devices");
        return NULL;
    }
    devices->setup = *setup;
    devices->port = setup->port ? *setup->port : hid_port_hidapi;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC);
    pthread_mutex_init(&devices->lock, NULL);
    pthread_cond_init(&devices->wake, &attributes);
    pthread_condattr_destroy(&attributes);
    return devices;
}

/* Loads the recording named by the setup, and rewinds to its start. */
static bool load_recording(Devices *devices, Error *error)
{
    if (!read_source(devices->setup.source, &devices->log, error))
        return false;
    devices->replayed = calloc(REPORT_LOG_DEVICES_MAX, sizeof *devices->replayed);
    if (!devices->replayed)
        return error_set(error, "no memory for motion devices");
    devices_rewind(devices);
    return true;
}

Devices *devices_open(const DevicesSetup *setup, Error *error)
{
    Devices *devices = create(setup, error);
    if (devices && setup->source && !load_recording(devices, error)) {
        free_devices(devices);
        return NULL;
    }
    return devices;
}

Devices *devices_start(const DevicesSetup *setup, Error *error)
{
    Devices *devices = devices_open(setup, error);
    if (!devices)
        return NULL;
    pthread_mutex_lock(&devices->lock);
    devices->began =
        devices_spawn(devices, &devices->thread, setup->source ? devices_replay : devices_scan, devices);
    pthread_mutex_unlock(&devices->lock);
    if (devices->began)
        return devices;
    error_set(error, "no thread for motion devices; end other programs");
    free_devices(devices);
    return NULL;
}

bool devices_ended(const Devices *devices)
{
    return atomic_load(&devices->played);
}

/* Joins a finished thread; detaches a thread blocked in a read. */
static void let_go(pthread_t thread, bool began, bool ended)
{
    if (began && ended)
        pthread_join(thread, NULL);
    else if (began)
        pthread_detach(thread);
}

void devices_stop(Devices *devices)
{
    if (!devices)
        return;
    const double until = wall_ms() + stop_patience_ms;
    pthread_mutex_lock(&devices->lock);
    devices->stopping = true;
    pthread_cond_broadcast(&devices->wake);
    while (devices->threads > 0 && wall_ms() < until)
        wait_for_wake(devices, until);
    for (Device *device = devices->list; device; device = device->next)
        let_go(device->thread, device->began, device->ended);
    let_go(devices->thread, devices->began, devices->ended);
    devices->left = devices->threads > 0;
    const bool whole = !devices->left;
    pthread_mutex_unlock(&devices->lock);
    if (whole)
        free_devices(devices);
}
