/* Fuzz target of the reader of recordings of raw reports: what it takes is in order and within its memory,
   and what it refuses it says with the line. */
#include "app/input/device/device.h"
#include "app/input/device/report.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void must(bool ok)
{
    if (!ok)
        abort();
}

static void check_entry(const ReportLog *log, const ReportLogEntry *entry)
{
    must(entry->time >= 0 && entry->time <= 1e6 && entry->device < log->device_count);
    must(entry->kind <= REPORT_LOG_UNPLUGGED && entry->size <= REPORT_LOG_REPORT_MAX);
    must(entry->offset <= log->byte_count && entry->size <= log->byte_count - entry->offset);
    must((entry->kind == REPORT_LOG_REPORT || entry->kind == REPORT_LOG_CALIBRATION) == (entry->size > 0));
}

/* As a replay does. */
static void play(const ReportLog *log)
{
    bool plugged[REPORT_LOG_DEVICES_MAX] = {false};
    DeviceState state = {0};
    for (size_t i = 0; i < log->count; i++) {
        const ReportLogEntry *entry = &log->entries[i];
        const ReportLogDevice *device = &log->devices[entry->device];
        const ReportFormat format = {.row = device->row,
                                     .layout = device->bluetooth ? device->row->bluetooth : device->row->usb,
                                     .calibration = calibration_nominal()};
        check_entry(log, entry);
        must(i == 0 || entry->time >= entry[-1].time);
        must(plugged[entry->device] == (entry->kind != REPORT_LOG_PLUGGED));
        plugged[entry->device] = entry->kind != REPORT_LOG_UNPLUGGED;
        if (entry->kind == REPORT_LOG_REPORT)
            report_parse(&format, log->bytes + entry->offset, entry->size, entry->time, &state);
    }
    for (int k = 0; k < log->device_count; k++)
        must(plugged[k] == log->devices[k].plugged);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    ReportLog log;
    Error error = {""};
    if (!report_log_parse("fuzz.rec", (const char *)data, size, &log, &error)) {
        must(strncmp(error.message, "fuzz.rec:", strlen("fuzz.rec:")) == 0);
        return 0;
    }
    play(&log);
    report_log_destroy(&log);
    return 0;
}
