#include "app/base/file.h"
#include "app/base/program.h"
#include "app/cli/cli_private.h"
#include "app/cli/option_rows.h"
#include "app/input/device/device.h"
#include "app/input/input.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct DevicesOptions {
    bool watch;                /* live values */
    const char *record;        /* FILE for raw reports, or NULL */
    const char *write_mapping; /* FILE, or NULL */
} DevicesOptions;

static const DevicesOptions *own(const Args *args)
{
    return args->own;
}

static int fail(int code, const Error *error)
{
    fprintf(stderr, "%s\n", error->message);
    return code;
}

static void print_known(void)
{
    printf("known are\n");
    for (int family = 0; family < DEVICE_FAMILY_COUNT; family++) {
        printf("  %s\n", device_family_title((DeviceFamily)family));
        for (const DeviceRow *row = device_rows; row->name; row++)
            if (row->family == (DeviceFamily)family)
                printf("    %04x:%04x  %s\n", row->vendor, row->product, row->name);
    }
}

static json_t *json_device(const DeviceRow *row)
{
    char id[16];
    snprintf(id, sizeof id, "%04x:%04x", row->vendor, row->product);
    return json_pack("{s:s, s:s, s:s}", "name", row->name, "family", device_family_word(row->family), "id",
                     id);
}

/* Writes {"devices": [...], "known": [...]}; takes the reference of `devices`. */
static bool write_json(const char *path, json_t *devices, Error *error)
{
    json_t *known = json_array();
    for (const DeviceRow *row = device_rows; row->name; row++)
        json_array_append_new(known, json_device(row));
    json_t *json = json_pack("{s:o, s:o}", "devices", devices, "known", known);
    const bool written = json_file_write(json, path, error);
    json_decref(json);
    return written;
}

static void print_found(const DeviceListing *found)
{
    char note[DEVICE_PROBLEM_SIZE];
    const char *problem = found->problem;
    device_note(found->row, note);
    printf("%s (%04x:%04x, %s, %s): %s\n", found->row->name, found->row->vendor, found->row->product,
           found->info.bluetooth ? "Bluetooth" : "USB", found->info.path, problem[0] ? problem : "ready");
    if (!problem[0] && note[0])
        printf("  %s\n", note);
}

static json_t *json_found(const DeviceListing *found)
{
    json_t *json = json_device(found->row);
    json_object_set_new(json, "bus", json_string(found->info.bluetooth ? "bluetooth" : "usb"));
    json_object_set_new(json, "path", json_string(found->info.path));
    json_object_set_new(json, "problem", found->problem[0] ? json_string(found->problem) : json_null());
    return json;
}

/* Lists the plugged in devices. */
static int list_found(const Args *args, Error *error)
{
    DeviceListing found[DEVICE_LIST_MAX];
    json_t *devices = json_array();
    const int count = device_list(&hid_port_hidapi, found);
    for (int i = 0; i < count; i++) {
        if (!args->quiet)
            print_found(&found[i]);
        json_array_append_new(devices, json_found(&found[i]));
    }
    if (count <= 0 && !args->quiet) {
        printf("no motion device is plugged in\n");
        print_known();
    }
    if (args->json && !write_json(args->json, devices, error))
        return fail(EXIT_FAILED, error);
    if (!args->json)
        json_decref(devices);
    return 0;
}

/* Count of reports of one device in a recording. */
static size_t reports_of(const ReportLog *log, int device)
{
    size_t reports = 0;
    for (size_t i = 0; i < log->count; i++)
        reports += log->entries[i].device == device && log->entries[i].kind == REPORT_LOG_REPORT;
    return reports;
}

static int list_recorded(const Args *args, Error *error)
{
    ReportLog log;
    json_t *devices = json_array();
    if (!report_log_read(args->device + strlen("file:"), &log, error)) {
        json_decref(devices);
        return fail(EXIT_USAGE, error);
    }
    for (int i = 0; i < log.device_count; i++) {
        const DeviceRow *row = log.devices[i].row;
        const char *bus = log.devices[i].bluetooth ? "bluetooth" : "usb";
        const size_t reports = reports_of(&log, i);
        if (!args->quiet)
            printf("%d %s (%04x:%04x, %s): %zu report%s\n", i + 1, row->name, row->vendor, row->product,
                   log.devices[i].bluetooth ? "Bluetooth" : "USB", reports, reports == 1 ? "" : "s");
        json_t *json = json_device(row);
        json_object_set_new(json, "bus", json_string(bus));
        json_object_set_new(json, "reports", json_integer((json_int_t)reports));
        json_array_append_new(devices, json);
    }
    if (!args->quiet)
        printf("%d device%s, %.2f s\n", log.device_count, log.device_count == 1 ? "" : "s",
               log.count ? log.entries[log.count - 1].time : 0);
    report_log_destroy(&log);
    if (args->json && !write_json(args->json, devices, error))
        return fail(EXIT_FAILED, error);
    if (!args->json)
        json_decref(devices);
    return 0;
}

static json_t *json_watched(const DevicesWatch *watch)
{
    json_t *devices = json_array();
    for (int i = 0; i < watch->count; i++) {
        const WatchedDevice *device = &watch->devices[i];
        json_t *json = json_device(device->row);
        json_object_set_new(json, "number", json_integer(device->number));
        json_object_set_new(json, "reports", json_integer((json_int_t)device->state.reports));
        json_object_set_new(json, "refused", json_integer((json_int_t)device->state.refused));
        json_object_set_new(json, "problem", device->problem[0] ? json_string(device->problem) : json_null());
        json_array_append_new(devices, json);
    }
    return devices;
}

static int watch_devices(const Args *args, Error *error)
{
    DevicesWatch watch;
    if (args->device && !devices_check(args->device, error))
        return fail(EXIT_USAGE, error);
    if (args->json && !json_file_check(args->json, error))
        return fail(EXIT_FAILED, error);
    watch = (DevicesWatch){.source = args->device,
                           .out = own(args)->watch && !args->quiet ? stdout : NULL,
                           .messages = args->quiet        ? NULL
                                       : own(args)->watch ? stdout
                                                          : stderr,
                           .bars = isatty(STDOUT_FILENO)};
    watch.record = own(args)->record ? report_log_create(own(args)->record, error) : NULL;
    if (own(args)->record && !watch.record)
        return fail(EXIT_FAILED, error);
    if (!args->quiet && !args->device)
        fprintf(stderr, "listening to motion devices; Ctrl-C ends it\n");
    const bool began = devices_watch(&watch, error);
    const bool recorded = report_log_close(watch.record, began ? error : NULL);
    if (!began || !recorded || (args->json && !write_json(args->json, json_watched(&watch), error)))
        return fail(EXIT_FAILED, error);
    if (watch.out_error) {
        fprintf(stderr, "slosh: standard output: %s\n", strerror(watch.out_error));
        return EXIT_FAILED;
    }
    return args->device && interrupted() ? EXIT_INTERRUPTED : 0;
}

/* Checks, explains and writes the mapping of devices. */
static int show_mapping(const Args *args, Error *error)
{
    Mapping mapping;
    if (own(args)->watch || own(args)->record || args->device || args->json) {
        error_set(error, "slosh devices: --mapping and --write-mapping look at no device; leave --watch, "
                         "--record, --device and --json out");
        return fail(EXIT_USAGE, error);
    }
    if (!mapping_load(args->mapping, &mapping, error))
        return fail(EXIT_USAGE, error);
    if (args->mapping && !args->quiet)
        mapping_explain(&mapping, stdout);
    if (own(args)->write_mapping && !mapping_write_new(&mapping, own(args)->write_mapping, error))
        return fail(EXIT_FAILED, error);
    return 0;
}

static int run_command(const Args *args)
{
    Error error = {{0}};
    if (args->mapping || own(args)->write_mapping)
        return show_mapping(args, &error);
    if (own(args)->watch || own(args)->record) {
        interrupt_install();
        return watch_devices(args, &error);
    }
    return args->device ? list_recorded(args, &error) : list_found(args, &error);
}

/* clang-format off */
static const OptionRow options[] = {
    {"--record", "FILE", OPTION_TEXT, OWN(DevicesOptions, record), .files = files_new, .help = "write all raw reports there, with their times, for --device file:FILE; until Ctrl-C"},
    ROW_DEVICE("a recording of motion devices in place of those that are plugged in"),
    ROW_MAPPING(.help = "check such a file, and say in words what devices do by it"),
    {"--write-mapping", "FILE", OPTION_TEXT, OWN(DevicesOptions, write_mapping), .files = files_new, .help = "write what devices do into a new file, to be changed"},
    {"--watch", NULL, OPTION_FLAG, OWN(DevicesOptions, watch), .help = "show what they say, live, until Ctrl-C or the end of the recording"},
    ROW_JSON, ROWS_END
};
/* clang-format on */

const Command command_devices = {
    .name = "devices",
    .usage = "[--watch] [--record FILE] [OPTIONS]",
    .help = "motion devices: which there are, what they say, and how to open them",
    .takes = "scene",
    .own_size = sizeof(DevicesOptions),
    .options = options,
    .run = run_command,
};
