#include "app/device/devices_state.h"

#include "sim/base/stage.h"

#include <math.h>

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

void *devices_replay(void *data)
{
    Devices *devices = data;
    pthread_mutex_lock(&devices->lock);
    play_all(devices);
    pthread_mutex_unlock(&devices->lock);
    atomic_store(&devices->played, true);
    devices_finish(devices, &devices->ended);
    return NULL;
}
