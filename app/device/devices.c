#include "app/device/devices_state.h"

#include "sim/base/stage.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

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

void devices_tell(Device *device, DeviceEventKind kind, const char *problem)
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

void devices_plugged(Device *device)
{
    Devices *devices = device->devices;
    if (devices->stopping)
        return;
    device->plugged = true;
    if (devices->setup.record)
        device->log_number = report_log_plugged(devices->setup.record, device->format.row, device->bluetooth);
    devices_tell(device, DEVICE_PLUGGED, "");
}

void devices_reported(Device *device, const uint8_t *bytes, size_t size, double time)
{
    Devices *devices = device->devices;
    const double now = wall_ms() / 1000;
    if (devices->stopping || !device->plugged)
        return;
    if (report_parse(&device->format, bytes, size, time, &device->state))
        devices_tell(device, DEVICE_REPORTED, "");
    if (devices->setup.record)
        report_log_report(devices->setup.record, device->log_number, now, bytes, size);
}

void devices_unplugged(Device *device)
{
    Devices *devices = device->devices;
    if (devices->stopping || !device->plugged)
        return;
    device->plugged = false;
    devices_tell(device, DEVICE_UNPLUGGED, "");
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

void devices_wait(Devices *devices, double until_ms)
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

bool devices_spawn(Devices *devices, pthread_t *thread, void *(*run)(void *), void *data)
{
    devices->threads++;
    if (pthread_create(thread, NULL, run, data) == 0)
        return true;
    devices->threads--;
    return false;
}

void devices_finish(Devices *devices, bool *ended)
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
        devices_spawn(devices, &devices->thread, setup->source ? devices_replay : devices_look, devices);
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
