#include "app/device/devices_state.h"

#include "sim/stage.h"

#include <stdlib.h>

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
    const uint8_t *bytes = devices->log.bytes + entry->offset;
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

/* Each event at its time; one that is late is told as soon as can be, none is left out. */
static void play_all(Devices *devices, Device *all)
{
    const double start = wall_ms();
    const ReportLog *log = &devices->log;
    for (size_t i = 0; i < log->count && !devices->stopping; i++) {
        const ReportLogEntry *entry = &log->entries[i];
        const double due = start + 1000 * entry->time;
        devices_wait(devices, due);
        play(devices, entry, &all[entry->device]);
    }
    for (int k = 0; k < log->device_count; k++)
        devices_unplugged(&all[k]);
}

void *devices_replay(void *data)
{
    Devices *devices = data;
    Device *all = calloc(REPORT_LOG_DEVICES_MAX, sizeof *all);
    pthread_mutex_lock(&devices->lock);
    for (int k = 0; all && k < REPORT_LOG_DEVICES_MAX; k++)
        all[k].devices = devices;
    if (all)
        play_all(devices, all);
    pthread_mutex_unlock(&devices->lock);
    free(all);
    atomic_store(&devices->played, true);
    devices_finish(devices, &devices->ended);
    return NULL;
}
