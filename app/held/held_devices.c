#include "app/held/held_devices.h"

#include "sim/box/box_motion.h"

#include <stdio.h>
#include <string.h>

void held_devices_start(HeldDevices *held, const Mapping *mapping)
{
    *held = (HeldDevices){.mapping = *mapping, .hand = hand_at_rest()};
}

bool held_device_in_use(const HeldDevice *device)
{
    return device->number > 0 && !device->problem[0];
}

static bool turns_box(const HeldDevice *device)
{
    return device->map.pose && device->orientation.begun;
}

/* Combines the devices' turns, in the order of plugging in. */
static void add_turn(const HeldDevice *device, HandInput *sum)
{
    double turned[4], of_box[4];
    if (!turns_box(device))
        return;
    orientation_turned(&device->orientation, turned);
    mapping_pose(&device->map, turned, of_box);
    if (sum->turned[3] == 0 && sum->turned[0] == 0 && sum->turned[1] == 0 && sum->turned[2] == 0)
        memcpy(sum->turned, of_box, sizeof of_box);
    else
        quat_multiply(of_box, sum->turned, sum->turned);
}

/* Adds a device's axes. A silent device keeps its offsets, and its rates are ignored. */
static void add_axes(const HeldDevice *device, HandInput *sum, double camera[3])
{
    HandInput all = *sum;
    double rates[3] = {camera[0], camera[1], camera[2]};
    mapping_add(&device->map, &device->state, &all, rates);
    if (device->silent > HELD_SILENCE) {
        memcpy(all.move_rate, sum->move_rate, sizeof all.move_rate);
        memcpy(all.tilt_rate, sum->tilt_rate, sizeof all.tilt_rate);
        all.spin_rate = sum->spin_rate;
    } else {
        memcpy(camera, rates, sizeof rates);
    }
    *sum = all;
}

/* Sums up the input of devices and everything else. */
static HandInput sum_up(const HeldDevices *held, double camera[3])
{
    HandInput sum = held->own;
    for (int i = 0; i < HELD_DEVICES_MAX; i++) {
        if (!held_device_in_use(&held->list[i]))
            continue;
        add_axes(&held->list[i], &sum, camera);
        add_turn(&held->list[i], &sum);
    }
    return sum;
}

bool held_devices_update(HeldDevices *held, double dt, double camera[3], BoxTarget *target)
{
    double rates[3] = {0};
    for (int i = 0; i < HELD_DEVICES_MAX; i++)
        held->list[i].silent += dt;
    HandInput sum = sum_up(held, rates);
    sum.dt = dt;
    for (int k = 0; k < 3; k++)
        camera[k] += rates[k] * dt;
    return hand_update(&held->hand, &sum, held->box_size, target);
}

void held_devices_neutral(HeldDevices *held)
{
    for (int i = 0; i < HELD_DEVICES_MAX; i++)
        orientation_neutral(&held->list[i].orientation);
}

void held_devices_home(HeldDevices *held)
{
    held_devices_neutral(held);
    hand_home(&held->hand);
}

void held_devices_let_go(HeldDevices *held, const BoxTarget *now)
{
    double camera[3] = {0};
    const HandInput still = sum_up(held, camera);
    hand_let_go(&held->hand, now, &still, held->box_size);
}

void held_devices_follow(HeldDevices *held, const BoxTarget *target)
{
    if (held->box_size[0] > 0)
        held_devices_let_go(held, target);
    else
        held->hand.held = *target;
    held->hand.told = *target;
}

static HeldDevice *find(HeldDevices *held, int number)
{
    for (int i = 0; i < HELD_DEVICES_MAX; i++)
        if (held->list[i].number == number)
            return &held->list[i];
    return NULL;
}

/* Removes a device and closes the gap, to keep the order. */
static void forget(HeldDevices *held, const HeldDevice *device)
{
    const size_t at = (size_t)(device - held->list);
    memmove(&held->list[at], &held->list[at + 1], (HELD_DEVICES_MAX - 1 - at) * sizeof *held->list);
    held->list[HELD_DEVICES_MAX - 1] = (HeldDevice){.number = 0};
}

/* Removes a refused device once it is plugged in again, or may be opened. */
static void forget_refused(HeldDevices *held, const DeviceEvent *event)
{
    for (int i = HELD_DEVICES_MAX - 1; i >= 0; i--) {
        const HeldDevice *device = &held->list[i];
        if (device->number > 0 && device->problem[0] && device->vendor == event->vendor &&
            device->product == event->product)
            forget(held, device);
    }
}

bool held_devices_add(HeldDevices *held, const DeviceEvent *event)
{
    forget_refused(held, event);
    HeldDevice *device = find(held, 0);
    if (!device)
        return false;
    *device = (HeldDevice){.number = event->number,
                           .family = event->family,
                           .vendor = event->vendor,
                           .product = event->product,
                           .map = *mapping_of(&held->mapping, event->family, event->vendor, event->product),
                           .orientation = orientation_start()};
    snprintf(device->name, sizeof device->name, "%s", event->name);
    if (event->kind == DEVICE_REFUSED)
        snprintf(device->problem, sizeof device->problem, "%s", event->problem);
    return true;
}

static bool is_as_left(const HeldDevices *held)
{
    bool same = true;
    for (int k = 0; k < 4; k++)
        same = same && held->hand.held.orientation[k] == held->left[k];
    return same;
}

/* Leaves the box at its last target. If an earlier unplugged device left the box there, that device's turn
   must be undone later, too. */
static void leave_box(HeldDevices *held, bool turned)
{
    const BoxTarget told = held->hand.told;
    if (turned && !is_as_left(held))
        memcpy(held->without, held->hand.held.orientation, sizeof held->without);
    held_devices_let_go(held, &told);
    if (turned)
        memcpy(held->left, held->hand.held.orientation, sizeof held->left);
}

bool held_devices_remove(HeldDevices *held, int number, HeldDevice *gone)
{
    const HeldDevice *device = find(held, number);
    if (!device)
        return false;
    *gone = *device;
    forget(held, device);
    if (held->box_size[0] > 0)
        leave_box(held, turns_box(gone));
    return true;
}

static void take_motion(HeldDevices *held, HeldDevice *device)
{
    const DeviceState *state = &device->state;
    const bool turned = turns_box(device);
    orientation_update(&device->orientation, state->time - state->late, state->angular_velocity,
                       state->acceleration);
    if (!turned && turns_box(device) && is_as_left(held))
        memcpy(held->hand.held.orientation, held->without, sizeof held->without);
}

bool held_devices_report(HeldDevices *held, const DeviceEvent *event, PlayCommand pressed[HELD_BUTTONS_MAX],
                         int *pressed_count)
{
    HeldDevice *device = find(held, event->number);
    const DeviceState *state = event->state;
    *pressed_count = 0;
    if (!device)
        return false;
    const uint32_t down = state->buttons & ~device->state.buttons;
    for (int bit = 0; bit < HELD_BUTTONS_MAX; bit++) {
        const PlayCommand command =
            down >> bit & 1 ? mapping_button(&device->map, device->vendor, device->product, bit) : PLAY_NONE;
        if (command != PLAY_NONE)
            pressed[(*pressed_count)++] = command;
    }
    device->state = *state;
    device->silent = 0;
    if (state->has_motion)
        take_motion(held, device);
    return true;
}
