#include "app/input/input.h"

#include "sim/base/base.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t add_log(uint64_t hash, const ReportLog *log)
{
    for (size_t i = 0; i < log->count; i++) {
        const ReportLogEntry *entry = &log->entries[i];
        const ReportLogDevice *device = &log->devices[entry->device];
        const uint16_t what[] = {entry->kind,         entry->device,        entry->size,
                                 device->row->vendor, device->row->product, device->bluetooth};
        hash = hash_add(hash, &entry->time, sizeof entry->time);
        hash = hash_add(hash, what, sizeof what);
        if (entry->size > 0) /* log->bytes is NULL if no report has a byte */
            hash = hash_add(hash, log->bytes + entry->offset, entry->size);
    }
    return hash;
}

/* Skips comments: they contain the user's path and may change between versions. */
static uint64_t add_yaml(uint64_t hash, const char *text)
{
    while (*text) {
        const size_t length = strcspn(text, "\n");
        if (text[strspn(text, " ")] != '#')
            hash = hash_add(hash, text, length);
        text += length + (text[length] != 0);
    }
    return hash;
}

static bool add_mapping(uint64_t *hash, const Mapping *mapping)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return false;
    mapping_write(mapping, file);
    const bool whole = fclose(file) == 0;
    if (whole)
        *hash = add_yaml(*hash, text);
    free(text);
    return whole;
}

bool device_replay_hash(const ReportLog *log, const Mapping *mapping, const HandInput *axes,
                        char mark[DEVICE_REPLAY_HASH_SIZE])
{
    uint64_t hash = add_log(HASH_NONE, log);
    hash = hash_add(hash, axes->right, sizeof axes->right);
    hash = hash_add(hash, axes->up, sizeof axes->up);
    hash = hash_add(hash, axes->away, sizeof axes->away);
    const bool ok = add_mapping(&hash, mapping);
    snprintf(mark, DEVICE_REPLAY_HASH_SIZE, "%016" PRIx64, hash);
    return ok;
}

/* Held inputs are integrated between two reports, like between pictures in the window. */
static const double LOOKS_A_SECOND = 60;

struct DeviceReplay {
    Devices *devices;
    char mark[DEVICE_REPLAY_HASH_SIZE];
    Mapping mapping;
    HandInput axes; /* of the camera */
    ControlDevices held;
    double time; /* s, played up to */
    double now;  /* s, of the last update of the hand */
    double looks;
    bool reported_full;
};

static void update(DeviceReplay *replay, double time)
{
    double camera[3] = {0};
    BoxTarget target; /* unused: also in hand.told */
    control_devices_update(&replay->held, time - replay->now, camera, &target);
    replay->now = time;
}

/* Handles the buttons for the box; remaining buttons matter only in a window. */
static void take_report(DeviceReplay *replay, const DeviceEvent *event)
{
    const UserAction *pressed[CONTROL_BUTTONS_MAX];
    int count;
    if (!control_devices_report(&replay->held, event, pressed, &count))
        return;
    for (int i = 0; i < count; i++)
        if (pressed[i]->on_devices)
            pressed[i]->on_devices(&replay->held);
    update(replay, event->state->time);
}

static void hear(void *user, const DeviceEvent *event)
{
    DeviceReplay *replay = user;
    ControlDevice gone;
    switch (event->kind) {
    case DEVICE_PLUGGED:
    case DEVICE_REFUSED:
        if (!control_devices_add(&replay->held, event) && !replay->reported_full) {
            fprintf(stderr, "%s is one device too many: what it reports is left out\n", event->name);
            replay->reported_full = true;
        }
        break;
    case DEVICE_UNPLUGGED:
        control_devices_remove(&replay->held, event->number, &gone);
        break;
    case DEVICE_REPORTED:
        take_report(replay, event);
        break;
    }
}

/* Axes of the initial camera; only its direction matters. */
static HandInput camera_axes(const Scene *scene)
{
    const BoxState home = {.orientation = {0, 0, 0, 1}};
    const Orbit orbit = orbit_begin(&scene->view, scene->world.box_size, &home, 16.0 / 9, (CoveredParts){0});
    HandInput axes = {.dt = 0};
    orbit_axes(&orbit, axes.right, axes.up, axes.away);
    return axes;
}

static void begin(DeviceReplay *replay)
{
    control_devices_start(&replay->held, &replay->mapping);
    replay->held.own = replay->axes;
    replay->time = replay->now = replay->looks = 0;
}

static bool load(DeviceReplay *replay, const char *source, const char *mapping, Error *error)
{
    const DevicesSetup setup = {.source = source, .listener = hear, .user = replay};
    if (!mapping_load(mapping, &replay->mapping, error) || !(replay->devices = devices_open(&setup, error)))
        return false;
    return device_replay_hash(devices_recording(replay->devices), &replay->mapping, &replay->axes,
                              replay->mark) ||
           error_set(error, "no memory for motion devices");
}

DeviceReplay *device_replay_open(const char *source, const char *mapping, const Scene *scene, Error *error)
{
    DeviceReplay *replay = calloc(1, sizeof *replay);
    if (!replay) {
        error_set(error, "no memory for motion devices");
        return NULL;
    }
    replay->axes = camera_axes(scene);
    if (!load(replay, source, mapping, error)) {
        device_replay_close(replay);
        return NULL;
    }
    begin(replay);
    return replay;
}

void device_replay_close(DeviceReplay *replay)
{
    if (!replay)
        return;
    devices_stop(replay->devices);
    free(replay);
}

const char *device_replay_mark(const DeviceReplay *replay)
{
    return replay ? replay->mark : "";
}

/* Plays the next event or look, whichever is first; returns false if later than `time`. */
static bool play_next(DeviceReplay *replay, double time)
{
    const double due = devices_due(replay->devices), look = (replay->looks + 1) / LOOKS_A_SECOND;
    if (due == INFINITY || fmin(due, look) > time)
        return false;
    if (due <= look) {
        devices_play_next(replay->devices);
    } else {
        replay->looks++;
        update(replay, look);
    }
    return true;
}

BoxTarget device_replay_target(DeviceReplay *replay, const double box_size[3], double time)
{
    if (time < replay->time) {
        devices_rewind(replay->devices);
        begin(replay);
    }
    memcpy(replay->held.box_size, box_size, sizeof replay->held.box_size);
    while (play_next(replay, time))
        continue;
    replay->time = time;
    return replay->held.hand.sent;
}

void device_replay_apply(DeviceReplay *replay, World *world)
{
    WorldInfo info;
    if (!replay)
        return;
    world_info(world, &info);
    const BoxTarget target = device_replay_target(replay, info.box_size, info.time);
    world_set_target(world, &target);
}
