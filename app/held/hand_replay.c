#include "app/held/hand_replay.h"

#include "app/hand/orbit.h"
#include "app/held/hand_mark.h"
#include "app/held/held_devices.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Held inputs are integrated between two reports, like between pictures in the window. */
static const double LOOKS_A_SECOND = 60;

struct HandReplay {
    Devices *devices;
    char mark[HAND_MARK_SIZE];
    Mapping mapping;
    HandInput axes; /* of the camera */
    HeldDevices held;
    double time; /* s, played up to */
    double now;  /* s, of the last update of the hand */
    double looks;
    bool told_full;
};

static void update(HandReplay *replay, double time)
{
    double camera[3] = {0};
    BoxTarget target; /* unused: also in hand.told */
    held_devices_update(&replay->held, time - replay->now, camera, &target);
    replay->now = time;
}

/* Handles the buttons for the box; remaining buttons matter only in a window. */
static void take_report(HandReplay *replay, const DeviceEvent *event)
{
    PlayCommand pressed[HELD_BUTTONS_MAX];
    int count;
    if (!held_devices_report(&replay->held, event, pressed, &count))
        return;
    for (int i = 0; i < count; i++) {
        if (pressed[i] == PLAY_BOX_HOME)
            held_devices_home(&replay->held);
        if (pressed[i] == PLAY_NEUTRAL)
            held_devices_neutral(&replay->held);
    }
    update(replay, event->state->time);
}

static void hear(void *user, const DeviceEvent *event)
{
    HandReplay *replay = user;
    HeldDevice gone;
    switch (event->kind) {
    case DEVICE_PLUGGED:
    case DEVICE_REFUSED:
        if (!held_devices_add(&replay->held, event) && !replay->told_full) {
            fprintf(stderr, "%s is one device too many: what it reports is left out\n", event->name);
            replay->told_full = true;
        }
        break;
    case DEVICE_UNPLUGGED:
        held_devices_remove(&replay->held, event->number, &gone);
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
    const Orbit orbit = orbit_begin(&scene->view, scene->world.box_size, &home, 16.0 / 9, (Covered){0});
    HandInput axes = {.dt = 0};
    orbit_axes(&orbit, axes.right, axes.up, axes.away);
    return axes;
}

static void begin(HandReplay *replay)
{
    held_devices_start(&replay->held, &replay->mapping);
    replay->held.own = replay->axes;
    replay->time = replay->now = replay->looks = 0;
}

static bool load(HandReplay *replay, const char *source, const char *mapping, Error *error)
{
    const DevicesSetup setup = {.source = source, .listener = hear, .user = replay};
    if (!mapping_load(mapping, &replay->mapping, error) || !(replay->devices = devices_open(&setup, error)))
        return false;
    return hand_mark(devices_recording(replay->devices), &replay->mapping, &replay->axes, replay->mark) ||
           error_set(error, "no memory for motion devices");
}

HandReplay *hand_replay_open(const char *source, const char *mapping, const Scene *scene, Error *error)
{
    HandReplay *replay = calloc(1, sizeof *replay);
    if (!replay) {
        error_set(error, "no memory for motion devices");
        return NULL;
    }
    replay->axes = camera_axes(scene);
    if (!load(replay, source, mapping, error)) {
        hand_replay_close(replay);
        return NULL;
    }
    begin(replay);
    return replay;
}

void hand_replay_close(HandReplay *replay)
{
    if (!replay)
        return;
    devices_stop(replay->devices);
    free(replay);
}

const char *hand_replay_mark(const HandReplay *replay)
{
    return replay ? replay->mark : "";
}

/* Plays the next event or look, whichever is first; returns false if later than `time`. */
static bool play_next(HandReplay *replay, double time)
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

BoxTarget hand_replay_at(HandReplay *replay, const double box_size[3], double time)
{
    if (time < replay->time) {
        devices_rewind(replay->devices);
        begin(replay);
    }
    memcpy(replay->held.box_size, box_size, sizeof replay->held.box_size);
    while (play_next(replay, time))
        continue;
    replay->time = time;
    return replay->held.hand.told;
}

void hand_replay_move(HandReplay *replay, World *world)
{
    WorldInfo info;
    if (!replay)
        return;
    world_info(world, &info);
    const BoxTarget target = hand_replay_at(replay, info.box_size, info.time);
    world_set_target(world, &target);
}
