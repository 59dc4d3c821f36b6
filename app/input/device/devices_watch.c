/* The state of a motion device as text. */
#include "app/input/device/device.h"

#include "app/base/program.h"
#include "sim/world.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>

/* A group of related values. */
typedef struct ValueGroup {
    const char *label, *names, *unit; /* names: one letter per value */
    size_t offset;                    /* of a double[] in DeviceState */
    int count;
    double least, most; /* ends of the bars */
} ValueGroup;

#define AT(field) offsetof(DeviceState, field)

static const ValueGroup cap_groups[] = {
    {"move", "xyz", "", AT(cap), 3, -1, 1},
    {"turn", "xyz", "", AT(cap[3]), 3, -1, 1},
    {0},
};

static const ValueGroup pad_groups[] = {
    {"turn", "xyz", " rad/s", AT(angular_velocity), 3, -5, 5},
    {"feel", "xyz", " m/s2", AT(acceleration), 3, -20, 20},
    {"left", "xy", "", AT(left), 2, -1, 1},
    {"right", "xy", "", AT(right), 2, -1, 1},
    {"pull", "lr", "", AT(triggers), 2, 0, 1},
    {0},
};

static const ValueGroup *groups_of(const DeviceRow *row)
{
    return row->family == DEVICE_SPACEMOUSE ? cap_groups : pad_groups;
}

static double value_of(const ValueGroup *group, const DeviceState *state, int k)
{
    const double *values = (const double *)((const char *)state + group->offset);
    return values[k] + 0.0; /* turns -0 into 0 */
}

static void show_buttons(FILE *file, const DeviceRow *row, uint32_t buttons)
{
    fputs("buttons", file);
    for (int bit = 0; bit < DEVICE_BUTTONS_MAX; bit++) {
        if (!(buttons >> bit & 1))
            continue;
        if (row->buttons[bit])
            fprintf(file, " %s", row->buttons[bit]);
        else
            fprintf(file, " bit%d", bit);
    }
}

/* Prints one line, without newline: "turn +0.10 -0.02 +0.00 rad/s, ... , buttons cross l1". */
static void device_show_line(FILE *file, const DeviceRow *row, const DeviceState *state)
{
    for (const ValueGroup *group = groups_of(row); group->label; group++) {
        fputs(group->label, file);
        for (int k = 0; k < group->count; k++)
            fprintf(file, " %+.2f", value_of(group, state, k));
        fprintf(file, "%s, ", group->unit);
    }
    show_buttons(file, row, state->buttons);
}

/* Prints a bar such as "[ ##| ]" from zero to the value. */
static void show_bar(FILE *file, const ValueGroup *group, double value)
{
    enum { CELLS = 10 }; /* for three bars with values in 80 columns */
    char bar[CELLS + 1];
    const double span = group->most - group->least;
    const int zero = (int)lround(-group->least / span * CELLS);
    const double shown = fmin(fmax(value, group->least), group->most);
    const int place = zero + (int)lround(shown / span * CELLS);
    for (int i = 0; i < CELLS; i++)
        bar[i] = (i >= zero && i < place) || (i < zero && i >= place) ? '#' : ' ';
    bar[CELLS] = 0;
    if (zero > 0)
        fprintf(file, "[%.*s|%s]", zero, bar, bar + zero);
    else
        fprintf(file, "[%s]", bar);
}

/* Prints one line per group of values, each value with a bar; the count of lines is constant per family. */
static void device_show_bars(FILE *file, const DeviceRow *row, const DeviceState *state)
{
    for (const ValueGroup *group = groups_of(row); group->label; group++) {
        fprintf(file, "  %-5s", group->label);
        for (int k = 0; k < group->count; k++) {
            const double value = value_of(group, state, k);
            fprintf(file, " %c", group->names[k]);
            show_bar(file, group, value);
            fprintf(file, "%+7.2f", value);
        }
        fprintf(file, "%s\n", group->unit);
    }
    fputs("  ", file);
    show_buttons(file, row, state->buttons);
    fputc('\n', file);
}

enum { PICTURE_MS = 50, LINE_MS = 100, LINE_SIZE = 512 };

/* What is shown of one device. */
typedef struct ShownDevice {
    int number;
    bool plugged, refused;
    uint64_t reports;
    double line_ms; /* wall time of the last printed line */
    char line[LINE_SIZE];
} ShownDevice;

typedef struct Watcher {
    pthread_mutex_t lock; /* guards `now` and `count`, written by the listener */
    WatchedDevice now[WATCH_DEVICES_MAX];
    int count;
    DevicesWatch *watch;
    ShownDevice shown[WATCH_DEVICES_MAX];
    double start; /* s; 0 for the clock of a recording */
    int lines;    /* count of lines with bars on the terminal */
} Watcher;

/* Returns a new place, or the place of the oldest unplugged device: a loose cable plugs in often. */
static WatchedDevice *place_for_one(Watcher *watcher)
{
    WatchedDevice *oldest = NULL;
    if (watcher->count < WATCH_DEVICES_MAX)
        return &watcher->now[watcher->count++];
    for (int i = 0; i < WATCH_DEVICES_MAX; i++) {
        WatchedDevice *device = &watcher->now[i];
        if (!device->plugged && (!oldest || device->number < oldest->number))
            oldest = device;
    }
    return oldest;
}

static WatchedDevice *find(Watcher *watcher, const DeviceEvent *event)
{
    for (int i = watcher->count - 1; i >= 0; i--)
        if (watcher->now[i].number == event->number)
            return &watcher->now[i];
    WatchedDevice *device = place_for_one(watcher);
    if (device)
        *device = (WatchedDevice){.number = event->number, .row = device_row(event->vendor, event->product)};
    return device;
}

static void listen(void *user, const DeviceEvent *event)
{
    Watcher *watcher = user;
    pthread_mutex_lock(&watcher->lock);
    WatchedDevice *device = find(watcher, event);
    if (device) {
        device->state = *event->state;
        device->plugged = event->kind == DEVICE_PLUGGED || event->kind == DEVICE_REPORTED;
        snprintf(device->problem, sizeof device->problem, "%s", event->problem);
    }
    pthread_mutex_unlock(&watcher->lock);
}

static void copy_now(Watcher *watcher)
{
    pthread_mutex_lock(&watcher->lock);
    watcher->watch->count = watcher->count;
    memcpy(watcher->watch->devices, watcher->now, (size_t)watcher->count * sizeof *watcher->now);
    pthread_mutex_unlock(&watcher->lock);
}

static void say_plugged(FILE *file, const WatchedDevice *device)
{
    char note[DEVICE_PROBLEM_SIZE];
    device_note(device->row, note);
    fprintf(file, "%d %s (%04x:%04x): plugged in%s%s\n", device->number, device->row->name,
            device->row->vendor, device->row->product, note[0] ? "; " : "", note);
}

/* Prints devices plugged in or unplugged since the last look. */
static void say_changes(const Watcher *watcher, const WatchedDevice *device, ShownDevice *shown)
{
    FILE *file = watcher->watch->messages;
    const bool refused = device->problem[0] != 0, was = shown->plugged;
    /* a device plugged and unplugged between two looks has reports, or is not worth a message */
    const bool came = !was && (device->plugged || device->state.reports > shown->reports);
    shown->plugged = device->plugged;
    if (!file)
        return;
    if (refused && !shown->refused)
        fprintf(file, "%d %s (%04x:%04x): %s\n", device->number, device->row->name, device->row->vendor,
                device->row->product, device->problem);
    shown->refused = refused;
    if (came)
        say_plugged(file, device);
}

static void say_gone(const Watcher *watcher, const WatchedDevice *device, bool was)
{
    if (watcher->watch->messages && was && !device->plugged)
        fprintf(watcher->watch->messages, "%d %s: unplugged after %llu report%s, %llu refused\n",
                device->number, device->row->name, (unsigned long long)device->state.reports,
                plural((size_t)device->state.reports), (unsigned long long)device->state.refused);
}

/* Prints a line if it differs from the last line, at a limited rate; the final line is always printed. */
static void show_line(const Watcher *watcher, const WatchedDevice *device, ShownDevice *shown, bool last)
{
    char line[LINE_SIZE] = "";
    const double now = wall_ms();
    if (device->state.reports == 0 || (!last && now - shown->line_ms < LINE_MS))
        return;
    FILE *text = fmemopen(line, sizeof line, "w");
    if (!text)
        return;
    device_show_line(text, device->row, &device->state);
    fclose(text);
    line[sizeof line - 1] = 0;
    if (strcmp(line, shown->line) == 0)
        return;
    memcpy(shown->line, line, sizeof line);
    shown->line_ms = now;
    fprintf(watcher->watch->out, "%.2f %d %s: %s\n", device->state.time - watcher->start, device->number,
            device->row->name, line);
}

static void write_bars(const DevicesWatch *watch, FILE *text)
{
    for (int i = 0; i < watch->count; i++) {
        const WatchedDevice *device = &watch->devices[i];
        if (!device->plugged)
            continue;
        fprintf(text, "%d %s: %llu report%s, %llu refused\n", device->number, device->row->name,
                (unsigned long long)device->state.reports, plural((size_t)device->state.reports),
                (unsigned long long)device->state.refused);
        device_show_bars(text, device->row, &device->state);
    }
}

/* Prints the bars, cut to the terminal's size: a wrapped or scrolled line could not be overwritten by the
   next picture. */
static void show_bars(Watcher *watcher)
{
    char *text = NULL;
    size_t size = 0;
    struct winsize capacity = {0};
    FILE *out = watcher->watch->out, *memory = open_memstream(&text, &size);
    watcher->lines = 0;
    if (!memory)
        return;
    write_bars(watcher->watch, memory);
    fclose(memory);
    const bool known =
        ioctl(fileno(out), TIOCGWINSZ, &capacity) == 0 && capacity.ws_col > 0 && capacity.ws_row > 0;
    const size_t columns = known ? capacity.ws_col : 80;
    const int rows = known ? capacity.ws_row : 24;
    for (const char *line = text; line && *line && watcher->lines < rows - 1; watcher->lines++) {
        const size_t length = strcspn(line, "\n");
        fprintf(out, "%.*s\033[K\n", (int)(length < columns ? length : columns - 1), line);
        line += length + 1;
    }
    free(text);
}

static void show(Watcher *watcher, bool last)
{
    DevicesWatch *watch = watcher->watch;
    copy_now(watcher);
    if (watch->out && watch->bars && watcher->lines > 0)
        fprintf(watch->out, "\033[%dA\033[J", watcher->lines);
    for (int i = 0; i < watch->count; i++) {
        const WatchedDevice *device = &watch->devices[i];
        ShownDevice *shown = &watcher->shown[i];
        if (shown->number != device->number)
            *shown = (ShownDevice){.number = device->number};
        const bool was = shown->plugged || device->state.reports > shown->reports;
        say_changes(watcher, device, shown);
        if (watch->out && !watch->bars)
            show_line(watcher, device, shown, last || (was && !device->plugged));
        say_gone(watcher, device, was);
        shown->reports = device->state.reports;
    }
    if (watch->out && watch->bars)
        show_bars(watcher);
    if (watch->out && fflush(watch->out) != 0 && watch->out_error == 0)
        watch->out_error = errno;
}

static bool goes_on(const Watcher *watcher, const Devices *devices)
{
    const DevicesWatch *watch = watcher->watch;
    return !interrupted() && !devices_ended(devices) &&
           !(watch->record && report_log_broken(watch->record)) && !(watch->out && ferror(watch->out));
}

bool devices_watch(DevicesWatch *watch, Error *error)
{
    const struct timespec pause = {.tv_nsec = PICTURE_MS * 1000000L};
    Watcher *watcher = calloc(1, sizeof *watcher);
    if (!watcher)
        return error_set(error, "no memory for motion devices");
    watcher->watch = watch;
    watcher->start = watch->source ? 0 : wall_ms() / 1000;
    pthread_mutex_init(&watcher->lock, NULL);
    const DevicesSetup setup = {
        .source = watch->source, .listener = listen, .user = watcher, .record = watch->record};
    Devices *devices = devices_start(&setup, error);
    while (devices && goes_on(watcher, devices)) {
        show(watcher, false);
        nanosleep(&pause, NULL);
    }
    devices_stop(devices);
    if (devices)
        show(watcher, true);
    pthread_mutex_destroy(&watcher->lock);
    free(watcher);
    return devices != NULL;
}
