#include "app/input/device/device.h"

#include "app/base/file.h"
#include "app/run/recording/recording.h"
#include "sim/world.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Parser of a line. */
typedef struct LogLine {
    LineReader *reader;
    const char *at, *end; /* the remaining text */
} LogLine;

enum { WORD_SIZE = 32 };

/* Takes the next word, up to a blank or the end; returns false if there is none, or the word is too long. */
static bool take_word(LogLine *line, char word[WORD_SIZE])
{
    const size_t left = (size_t)(line->end - line->at);
    const char *blank = memchr(line->at, ' ', left);
    const size_t length = blank ? (size_t)(blank - line->at) : left;
    if (length == 0 || length >= WORD_SIZE)
        return false;
    memcpy(word, line->at, length);
    word[length] = 0;
    line->at += length + (blank != NULL);
    return true;
}

static bool all_of(const char *word, const char *set)
{
    return *word && !word[strspn(word, set)];
}

/* Grows an array for `more` more elements of `size` bytes. */
static bool grow(void **array, size_t count, size_t *capacity, size_t more, size_t size)
{
    if (count + more <= *capacity)
        return true;
    const size_t larger = 2 * (count + more) + 64;
    void *grown = realloc(*array, larger * size);
    if (!grown)
        return false;
    *array = grown;
    *capacity = larger;
    return true;
}

/* Reads the next line, without a carriage return possibly added by mail. */
static bool next_line(LineReader *reader)
{
    if (!line_reader_next(reader))
        return false;
    reader->length -= reader->length > 0 && reader->line[reader->length - 1] == '\r';
    return true;
}

static bool no_memory(const LineReader *reader)
{
    return line_reader_fail(reader, "no memory to read it");
}

static bool take_time(LogLine *line, double before, double *time)
{
    char word[WORD_SIZE];
    if (!take_word(line, word) || !all_of(word, "0123456789.") || strchr(word, '.') != strrchr(word, '.') ||
        !strpbrk(word, "0123456789"))
        return line_reader_fail(line->reader, "the line must begin with a time in s, such as 0.004");
    *time = strtod(word, NULL);
    if (*time > 1e6)
        return line_reader_fail(line->reader, "%s s is later than any; at most 1000000 is", word);
    return *time >= before ||
           line_reader_fail(line->reader, "%s s is before the line above; put them in order", word);
}

/* Takes the device's number, counted from 1 in the file. */
static bool take_device(LogLine *line, int count, int *device)
{
    char word[WORD_SIZE];
    if (!take_word(line, word) || !all_of(word, "0123456789") || strlen(word) > 4)
        return line_reader_fail(line->reader, "after the time must stand the number of a device, such as 1");
    *device = (int)strtol(word, NULL, 10) - 1;
    return (*device >= 0 && *device <= count) ||
           line_reader_fail(line->reader, "no device %s was plugged in; the next one is %d", word, count + 1);
}

static bool take_id(LogLine *line, const DeviceRow **row)
{
    char word[WORD_SIZE];
    *row = NULL;
    if (!take_word(line, word) || strlen(word) != 9 || word[4] != ':' ||
        strspn(word, "0123456789abcdefABCDEF") != 4 || strspn(word + 5, "0123456789abcdefABCDEF") != 4)
        return line_reader_fail(line->reader,
                                "after the family must stand VENDOR:PRODUCT, such as 054c:0ce6");
    *row = device_row((uint16_t)strtoul(word, NULL, 16), (uint16_t)strtoul(word + 5, NULL, 16));
    return *row ||
           line_reader_fail(line->reader,
                            "%s is no motion device that this slosh knows; `slosh devices` lists them", word);
}

/* "dualsense 054c:0ce6 usb NAME" */
static bool take_plugged(LogLine *line, ReportLog *out, int device)
{
    char family[WORD_SIZE], bus[WORD_SIZE];
    const DeviceRow *row;
    if (device != out->device_count)
        return line_reader_fail(line->reader, "device %d was plugged in before; a new one is %d", device + 1,
                                out->device_count + 1);
    if (device == REPORT_LOG_DEVICES_MAX)
        return line_reader_fail(line->reader, "more than %d devices; cut the recording here",
                                REPORT_LOG_DEVICES_MAX);
    if (!take_word(line, family))
        return line_reader_fail(line->reader, "after 'plugged' must stand the family, such as dualsense");
    if (!take_id(line, &row))
        return false;
    if (strcmp(family, device_family_word(row->family)) != 0)
        return line_reader_fail(line->reader, "%04x:%04x is no '%s'; its family is %s", row->vendor,
                                row->product, family, device_family_word(row->family));
    if (!take_word(line, bus) || (strcmp(bus, "usb") != 0 && strcmp(bus, "bluetooth") != 0))
        return line_reader_fail(line->reader, "after VENDOR:PRODUCT must stand usb or bluetooth");
    out->devices[out->device_count++] =
        (ReportLogDevice){.row = row, .bluetooth = strcmp(bus, "bluetooth") == 0, .plugged = true};
    return true;
}

static int digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/* Takes the rest of the line: a report in hexadecimal digits. */
static bool take_bytes(LogLine *line, ReportLog *out, ReportLogEntry *entry)
{
    const size_t digits = (size_t)(line->end - line->at), size = digits / 2;
    if (digits == 0 || digits % 2 || size > REPORT_LOG_REPORT_MAX)
        return line_reader_fail(line->reader,
                                "a report must stand here: 2 to %d hexadecimal digits, two a byte",
                                2 * REPORT_LOG_REPORT_MAX);
    if (!grow((void **)&out->bytes, out->byte_count, &out->byte_capacity, size, 1))
        return no_memory(line->reader);
    entry->offset = out->byte_count;
    entry->size = (uint16_t)size;
    for (size_t i = 0; i < size; i++) {
        const int high = digit(line->at[2 * i]), low = digit(line->at[2 * i + 1]);
        if (high < 0 || low < 0)
            return line_reader_fail(line->reader,
                                    "'%.2s' is no byte; a report is hexadecimal digits, two a byte",
                                    line->at + 2 * i);
        out->bytes[out->byte_count++] = (uint8_t)(high << 4 | low);
    }
    return true;
}

static bool take_kind(LogLine *line, ReportLogEntry *entry)
{
    static const char *const words[] = {"plugged", "calibration", "report", "unplugged"};
    char word[WORD_SIZE] = "";
    if (take_word(line, word))
        for (int kind = REPORT_LOG_PLUGGED; kind <= REPORT_LOG_UNPLUGGED; kind++)
            if (strcmp(word, words[kind]) == 0) {
                entry->kind = (uint8_t)kind;
                return true;
            }
    return line_reader_fail(
        line->reader, "'%s' is no event; after the device stands plugged, calibration, report or unplugged",
        word);
}

/* Takes the rest of a line after the kind of event. */
static bool take_rest(LogLine *line, ReportLog *out, ReportLogEntry *entry, int device)
{
    if (entry->kind == REPORT_LOG_PLUGGED)
        return take_plugged(line, out, device);
    if (device == out->device_count || !out->devices[device].plugged)
        return line_reader_fail(line->reader,
                                "device %d is not plugged in here; a line with 'plugged' must come before",
                                device + 1);
    if (entry->kind != REPORT_LOG_UNPLUGGED)
        return take_bytes(line, out, entry);
    out->devices[device].plugged = false;
    return line->at == line->end ||
           line_reader_fail(line->reader, "something follows 'unplugged'; leave it out");
}

static bool read_entry(LineReader *reader, ReportLog *out)
{
    LogLine line = {.reader = reader, .at = reader->line, .end = reader->line + reader->length};
    ReportLogEntry entry = {0};
    int device = 0;
    const double before = out->count > 0 ? out->entries[out->count - 1].time : 0;
    if (!take_time(&line, before, &entry.time) || !take_device(&line, out->device_count, &device) ||
        !take_kind(&line, &entry) || !take_rest(&line, out, &entry, device))
        return false;
    entry.device = (uint8_t)device;
    if (!grow((void **)&out->entries, out->count, &out->capacity, 1, sizeof *out->entries))
        return no_memory(reader);
    out->entries[out->count++] = entry;
    return true;
}

/* Reads the first two lines. */
static bool read_head(LineReader *reader)
{
    reader->number = 1;
    if (!line_reader_begins(reader, "slosh device recording "))
        return line_reader_fail(
            reader, "this is no recording of devices; the first line of one is "
                    "'slosh device recording 1', and `slosh devices --watch --record FILE` makes one");
    if (!memchr(reader->at, '\n', (size_t)(reader->end - reader->at)))
        return line_reader_fail(reader, "the recording was cut in its first line; take a whole one");
    reader->number = 0;
    if (!next_line(reader) || !line_reader_is(reader, "slosh device recording 1"))
        return line_reader_misplaced(reader,
                                     "'slosh device recording 1', the one format that this slosh reads,");
    if (line_reader_begins(reader, "program "))
        next_line(reader);
    return true;
}

bool report_log_parse(const char *path, const char *bytes, size_t size, ReportLog *out, Error *error)
{
    LineReader reader = {.path = path, .at = bytes, .end = bytes + size, .error = error};
    *out = (ReportLog){0};
    bool ok = read_head(&reader);
    while (ok && next_line(&reader))
        ok = read_entry(&reader, out);
    if (!ok)
        report_log_destroy(out);
    return ok;
}

/* The file is read twice, for checking and for playing: a pipe is refused. */
static bool stays_there(const char *path, Error *error)
{
    struct stat status;
    return stat(path, &status) != 0 || S_ISREG(status.st_mode) || S_ISDIR(status.st_mode) ||
           error_set(error, "%s: not a plain file; save the recording as one and name that", path);
}

bool report_log_read(const char *path, ReportLog *out, Error *error)
{
    size_t size;
    *out = (ReportLog){0};
    if (!stays_there(path, error))
        return false;
    char *bytes = read_file(path, REPORT_LOG_BYTES_MAX, "recording", &size, error);
    const bool ok = bytes && report_log_parse(path, bytes, size, out, error);
    free(bytes);
    return ok;
}

void report_log_destroy(ReportLog *log)
{
    free(log->entries);
    free(log->bytes);
    *log = (ReportLog){0};
}

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
