#include "app/input/device/device.h"

#include "app/base/program.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <hidapi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* True if udev reads rules in the folder without installation: udev(7). */
static bool read_by_udev(const char *rule)
{
    static const char *const prefixes[] = {"/usr/lib/udev/", "/usr/local/lib/udev/", "/lib/udev/"};
    for (size_t i = 0; i < sizeof prefixes / sizeof *prefixes; i++)
        if (strncmp(rule, prefixes[i], strlen(prefixes[i])) == 0)
            return true;
    return false;
}

bool device_rules_command(char command[DEVICE_COMMAND_SIZE])
{
    static const char again[] = "sudo udevadm trigger --subsystem-match=hidraw";
    char rule[PROGRAM_PATH_SIZE];
    if (program_sources())
        snprintf(command, DEVICE_COMMAND_SIZE,
                 strchr(program_sources(), ' ') ? "'%s/tools/setup' --devices" : "%s/tools/setup --devices",
                 program_sources());
    else if (!program_udev_rule(rule))
        return false;
    else if (read_by_udev(rule))
        snprintf(command, DEVICE_COMMAND_SIZE, "%s", again);
    else
        snprintf(command, DEVICE_COMMAND_SIZE, "sudo cp '%.200s' /etc/udev/rules.d && %s", rule, again);
    return true;
}

const DeviceRow *device_match(const HidInfo *info)
{
    /* HID usage tables, page 1: joystick 4, gamepad 5, multi-axis controller 8 */
    const bool motion = info->usage_page == 0 ||
                        (info->usage_page == 1 && (info->usage == 4 || info->usage == 5 || info->usage == 8));
    return motion ? device_row(info->vendor, info->product) : NULL;
}

/* True if the file's first line equals `line`. */
static bool has_line(const char *path, const char *line)
{
    char text[64] = "";
    FILE *file = fopen(path, "r");
    if (!file)
        return false;
    const bool read = fgets(text, sizeof text, file) != NULL;
    fclose(file);
    text[strcspn(text, "\n")] = 0;
    return read && strcmp(text, line) == 0;
}

long device_process(const char *folder, const char *name)
{
    long found = 0;
    DIR *processes = opendir(folder);
    for (struct dirent *entry; processes && !found && (entry = readdir(processes));) {
        char path[512];
        if (entry->d_name[strspn(entry->d_name, "0123456789")])
            continue;
        snprintf(path, sizeof path, "%s/%s/comm", folder, entry->d_name);
        found = has_line(path, name) ? strtol(entry->d_name, NULL, 10) : 0;
    }
    if (processes)
        closedir(processes);
    return found;
}

/* Returns the id of spacenavd, which reads every SpaceMouse for other programs, or 0. */
static long device_spacenavd(void)
{
    return access("/run/spnav.sock", F_OK) == 0 || access("/var/run/spnav.sock", F_OK) == 0
               ? device_process("/proc", "spacenavd")
               : 0;
}

static void busy(const DeviceRow *row, char problem[DEVICE_PROBLEM_SIZE])
{
    const long process = row->family == DEVICE_SPACEMOUSE ? device_spacenavd() : 0;
    if (process)
        snprintf(problem, DEVICE_PROBLEM_SIZE,
                 "spacenavd (process %ld) holds it; `sudo systemctl stop spacenavd` frees it", process);
    else
        snprintf(problem, DEVICE_PROBLEM_SIZE, "another program holds it; end that program");
}

void device_problem(const DeviceRow *row, HidRefusal why, const char *reason,
                    char problem[DEVICE_PROBLEM_SIZE])
{
    char command[DEVICE_COMMAND_SIZE];
    switch (why) {
    case HID_DENIED:
        if (device_rules_command(command))
            snprintf(problem, DEVICE_PROBLEM_SIZE, "this user may not open it; `%s` allows it for good",
                     command);
        else
            snprintf(problem, DEVICE_PROBLEM_SIZE,
                     "this user may not open it; the rule 70-slosh.rules that comes with slosh allows it");
        return;
    case HID_BUSY:
        busy(row, problem);
        return;
    case HID_FAILED:
        break;
    }
    snprintf(problem, DEVICE_PROBLEM_SIZE, "it cannot be opened (%.200s); unplug it and plug it in again",
             reason);
}

void device_note(const DeviceRow *row, char note[DEVICE_PROBLEM_SIZE])
{
    const long process = row->family == DEVICE_SPACEMOUSE ? device_spacenavd() : 0;
    note[0] = 0;
    if (process)
        snprintf(
            note, DEVICE_PROBLEM_SIZE,
            "spacenavd (process %ld) reads it too, for other programs; where nothing arrives here, `sudo systemctl stop spacenavd`",
            process);
}

enum { INFOS_MAX = 256 };

static bool has_path(const DeviceListing *found, int count, const char *path)
{
    for (int i = 0; i < count; i++)
        if (strcmp(found[i].info.path, path) == 0)
            return true;
    return false;
}

static void try_open(const HidPort *port, DeviceListing *found)
{
    HidRefusal why = HID_FAILED;
    char reason[HID_REASON_SIZE] = "";
    void *handle = port->open(port->self, found->info.path, &why, reason);
    if (handle)
        port->close(handle);
    else
        device_problem(found->row, why, reason, found->problem);
}

int device_list(const HidPort *port, DeviceListing out[DEVICE_LIST_MAX])
{
    HidInfo *infos = malloc(INFOS_MAX * sizeof *infos);
    const int seen = infos ? port->enumerate(port->self, infos, INFOS_MAX) : -1;
    int count = seen < 0 || seen > INFOS_MAX ? -1 : 0;
    for (int i = 0; i < seen && count >= 0 && count < DEVICE_LIST_MAX; i++) {
        const DeviceRow *row = device_match(&infos[i]);
        if (!row || has_path(out, count, infos[i].path))
            continue;
        out[count] = (DeviceListing){.info = infos[i], .row = row};
        try_open(port, &out[count++]);
    }
    free(infos);
    return count;
}

static int enumerate(void *self, HidInfo *out, int max)
{
    (void)self;
    int count = 0;
    struct hid_device_info *list = hid_enumerate(0, 0);
    for (const struct hid_device_info *info = list; info && count < max; info = info->next) {
        if (!info->path || strlen(info->path) >= HID_PATH_SIZE)
            continue;
        HidInfo *place = &out[count++];
        *place = (HidInfo){.vendor = info->vendor_id,
                           .product = info->product_id,
                           .bluetooth = info->bus_type == HID_API_BUS_BLUETOOTH,
                           .usage_page = info->usage_page,
                           .usage = info->usage};
        snprintf(place->path, sizeof place->path, "%s", info->path);
    }
    hid_free_enumeration(list);
    return count;
}

/* hidapi reports failures only as text: finds the reason by opening the file. */
static void explain(const char *path, HidRefusal *why, char reason[HID_REASON_SIZE])
{
    const wchar_t *words = hid_error(NULL);
    snprintf(reason, HID_REASON_SIZE, "%ls", words ? words : L"it does not open");
    const int file = open(path, O_RDWR | O_CLOEXEC);
    const int number = errno;
    if (file >= 0)
        close(file);
    *why = file >= 0                             ? HID_FAILED
           : number == EACCES || number == EPERM ? HID_DENIED
           : number == EBUSY                     ? HID_BUSY
                                                 : HID_FAILED;
}

static void *open_path(void *self, const char *path, HidRefusal *why, char reason[HID_REASON_SIZE])
{
    (void)self;
    hid_device *device = hid_open_path(path);
    if (!device)
        explain(path, why, reason);
    return device;
}

static int read_report(void *handle, uint8_t *bytes, size_t size, int timeout_ms)
{
    return hid_read_timeout(handle, bytes, size, timeout_ms);
}

static int get_feature(void *handle, uint8_t *bytes, size_t size)
{
    return hid_get_feature_report(handle, bytes, size);
}

static void close_device(void *handle)
{
    hid_close(handle);
}

const HidPort hid_port_hidapi = {.look_ms = 1000,
                                 .enumerate = enumerate,
                                 .open = open_path,
                                 .read = read_report,
                                 .get_feature = get_feature,
                                 .close = close_device};
