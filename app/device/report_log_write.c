#include "app/base/output.h"
#include "app/device/report_log.h"
#include "sim/base/stage.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct ReportLogWriter {
    FILE *file;
    char path[1024];
    double start, last; /* wall_ms at the start, s; time since then of the last line, s */
    int devices;
    int number; /* errno of the first failed line; 0: none */
};

static double now(void)
{
    return wall_ms() / 1000;
}

bool report_log_broken(const ReportLogWriter *writer)
{
    return writer->number != 0;
}

static void keep_failure(ReportLogWriter *writer)
{
    if (writer->number == 0)
        writer->number = errno ? errno : EIO;
}

/* Begins a line with time and device. Two devices are read in parallel: a report may arrive after a later
   one. Returns false after an incomplete line, as no line can follow. */
static bool begin_line(ReportLogWriter *writer, int number, double time)
{
    if (report_log_broken(writer))
        return false;
    const double since = time - writer->start;
    writer->last = since > writer->last ? since : writer->last;
    errno = 0;
    fprintf(writer->file, "%.6f %d ", writer->last, number);
    return true;
}

static void end_line(ReportLogWriter *writer)
{
    putc('\n', writer->file);
    if (fflush(writer->file) != 0)
        keep_failure(writer);
}

/* The head goes into a temporary file first, so that a file of this name always is a recording. */
ReportLogWriter *report_log_create(const char *path, Error *error)
{
    Output output = {0};
    if (access(path, F_OK) == 0) {
        error_set(error, "%s: is there already, and stays as it is; name a new file", path);
        return NULL;
    }
    ReportLogWriter *writer = calloc(1, sizeof *writer);
    if (!writer) {
        error_set(error, "%s: no memory to record", path);
        return NULL;
    }
    if (!output_begin(&output, path, error)) {
        free(writer);
        return NULL;
    }
    writer->start = now();
    writer->file = fopen(output.temp, "w");
    snprintf(writer->path, sizeof writer->path, "%s", path);
    const bool begun = writer->file &&
                       fprintf(writer->file, "slosh device recording 1\nprogram %s\n", SLOSH_VERSION) > 0 &&
                       fflush(writer->file) == 0;
    if (!begun)
        error_set(error, "%s: cannot be written (%s)", path, strerror(errno));
    if (begun && output_commit(&output, error))
        return writer;
    output_discard(&output);
    if (writer->file)
        fclose(writer->file);
    free(writer);
    return NULL;
}

int report_log_plugged(ReportLogWriter *writer, const DeviceRow *row, bool bluetooth)
{
    if (writer->devices == REPORT_LOG_DEVICES_MAX)
        return 0;
    if (!begin_line(writer, ++writer->devices, now()))
        return writer->devices;
    fprintf(writer->file, "plugged %s %04x:%04x %s %s", device_family_word(row->family), row->vendor,
            row->product, bluetooth ? "bluetooth" : "usb", row->name);
    end_line(writer);
    return writer->devices;
}

static void write_bytes(ReportLogWriter *writer, int number, double time, const char *word,
                        const uint8_t *bytes, size_t size)
{
    if (number == 0 || size == 0 || size > REPORT_LOG_REPORT_MAX || !begin_line(writer, number, time))
        return;
    fprintf(writer->file, "%s ", word);
    for (size_t i = 0; i < size; i++) {
        putc("0123456789abcdef"[bytes[i] >> 4], writer -> file);
        putc("0123456789abcdef"[bytes[i] & 15], writer -> file);
    }
    end_line(writer);
}

void report_log_calibration(ReportLogWriter *writer, int number, const uint8_t *bytes, size_t size)
{
    write_bytes(writer, number, now(), "calibration", bytes, size);
}

void report_log_report(ReportLogWriter *writer, int number, double time, const uint8_t *bytes, size_t size)
{
    write_bytes(writer, number, time, "report", bytes, size);
}

void report_log_unplugged(ReportLogWriter *writer, int number)
{
    if (number == 0 || !begin_line(writer, number, now()))
        return;
    fputs("unplugged", writer->file);
    end_line(writer);
}

bool report_log_close(ReportLogWriter *writer, Error *error)
{
    if (!writer)
        return true;
    errno = 0;
    if (fclose(writer->file) != 0)
        keep_failure(writer);
    const bool whole =
        writer->number == 0 || error_set(error, "%s: cannot be written (%s); what came before is whole",
                                         writer->path, strerror(writer->number));
    free(writer);
    return whole;
}
