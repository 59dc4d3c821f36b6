#include "app/input/input.h"

#include "sim/def.h"

#include <stdio.h>
#include <string.h>

void control_devices_start(ControlDevices *devices, const Mapping *mapping)
{
    *devices = (ControlDevices){.mapping = *mapping, .hand = hand_at_rest()};
}

bool control_device_in_use(const ControlDevice *device)
{
    return device->number > 0 && !device->problem[0];
}

static bool turns_box(const ControlDevice *device)
{
    return device->map.pose && device->orientation.begun;
}

/* Combines the devices' turns, in the order of plugging in. */
static void add_turn(const ControlDevice *device, HandInput *sum)
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
static void add_axes(const ControlDevice *device, HandInput *sum, double camera[3])
{
    HandInput all = *sum;
    double rates[3] = {camera[0], camera[1], camera[2]};
    mapping_add(&device->map, &device->state, &all, rates);
    if (device->silent > CONTROL_SILENCE) {
        memcpy(all.move_rate, sum->move_rate, sizeof all.move_rate);
        memcpy(all.tilt_rate, sum->tilt_rate, sizeof all.tilt_rate);
        all.spin_rate = sum->spin_rate;
    } else {
        memcpy(camera, rates, sizeof rates);
    }
    *sum = all;
}

/* Sums up the input of devices and everything else. */
static HandInput sum_up(const ControlDevices *devices, double camera[3])
{
    HandInput sum = devices->own;
    for (int i = 0; i < CONTROL_DEVICES_MAX; i++) {
        if (!control_device_in_use(&devices->list[i]))
            continue;
        add_axes(&devices->list[i], &sum, camera);
        add_turn(&devices->list[i], &sum);
    }
    return sum;
}

bool control_devices_update(ControlDevices *devices, double dt, double camera[3], BoxTarget *target)
{
    double rates[3] = {0};
    for (int i = 0; i < CONTROL_DEVICES_MAX; i++)
        devices->list[i].silent += dt;
    HandInput sum = sum_up(devices, rates);
    sum.dt = dt;
    for (int k = 0; k < 3; k++)
        camera[k] += rates[k] * dt;
    return hand_update(&devices->hand, &sum, devices->box_size, target);
}

void control_devices_neutral(ControlDevices *devices)
{
    for (int i = 0; i < CONTROL_DEVICES_MAX; i++)
        orientation_neutral(&devices->list[i].orientation);
}

void control_devices_home(ControlDevices *devices)
{
    control_devices_neutral(devices);
    hand_home(&devices->hand);
}

void control_devices_release(ControlDevices *devices, const BoxTarget *now)
{
    double camera[3] = {0};
    const HandInput still = sum_up(devices, camera);
    hand_release(&devices->hand, now, &still, devices->box_size);
}

void control_devices_set_target(ControlDevices *devices, const BoxTarget *target)
{
    if (devices->box_size[0] > 0)
        control_devices_release(devices, target);
    else
        devices->hand.held = *target;
    devices->hand.sent = *target;
}

static ControlDevice *find(ControlDevices *devices, int number)
{
    for (int i = 0; i < CONTROL_DEVICES_MAX; i++)
        if (devices->list[i].number == number)
            return &devices->list[i];
    return NULL;
}

/* Removes a device and closes the gap, to keep the order. */
static void forget(ControlDevices *devices, const ControlDevice *device)
{
    const size_t at = (size_t)(device - devices->list);
    memmove(&devices->list[at], &devices->list[at + 1],
            (CONTROL_DEVICES_MAX - 1 - at) * sizeof *devices->list);
    devices->list[CONTROL_DEVICES_MAX - 1] = (ControlDevice){.number = 0};
}

/* Removes a refused device once it is plugged in again, or may be opened. */
static void forget_refused(ControlDevices *devices, const DeviceEvent *event)
{
    for (int i = CONTROL_DEVICES_MAX - 1; i >= 0; i--) {
        const ControlDevice *device = &devices->list[i];
        if (device->number > 0 && device->problem[0] && device->vendor == event->vendor &&
            device->product == event->product)
            forget(devices, device);
    }
}

bool control_devices_add(ControlDevices *devices, const DeviceEvent *event)
{
    forget_refused(devices, event);
    ControlDevice *device = find(devices, 0);
    if (!device)
        return false;
    *device =
        (ControlDevice){.number = event->number,
                        .family = event->family,
                        .vendor = event->vendor,
                        .product = event->product,
                        .map = *mapping_of(&devices->mapping, event->family, event->vendor, event->product),
                        .orientation = orientation_start()};
    snprintf(device->name, sizeof device->name, "%s", event->name);
    if (event->kind == DEVICE_REFUSED)
        snprintf(device->problem, sizeof device->problem, "%s", event->problem);
    return true;
}

static bool is_as_left(const ControlDevices *devices)
{
    bool same = true;
    for (int k = 0; k < 4; k++)
        same = same && devices->hand.held.orientation[k] == devices->left[k];
    return same;
}

/* Leaves the box at its last target. If an earlier unplugged device left the box there, that device's turn
   must be undone later, too. */
static void leave_box(ControlDevices *devices, bool turned)
{
    const BoxTarget sent = devices->hand.sent;
    if (turned && !is_as_left(devices))
        memcpy(devices->without, devices->hand.held.orientation, sizeof devices->without);
    control_devices_release(devices, &sent);
    if (turned)
        memcpy(devices->left, devices->hand.held.orientation, sizeof devices->left);
}

bool control_devices_remove(ControlDevices *devices, int number, ControlDevice *gone)
{
    const ControlDevice *device = find(devices, number);
    if (!device)
        return false;
    *gone = *device;
    forget(devices, device);
    if (devices->box_size[0] > 0)
        leave_box(devices, turns_box(gone));
    return true;
}

static void take_motion(ControlDevices *devices, ControlDevice *device)
{
    const DeviceState *state = &device->state;
    const bool turned = turns_box(device);
    orientation_update(&device->orientation, state->time - state->late, state->angular_velocity,
                       state->acceleration);
    if (!turned && turns_box(device) && is_as_left(devices))
        memcpy(devices->hand.held.orientation, devices->without, sizeof devices->without);
}

bool control_devices_report(ControlDevices *devices, const DeviceEvent *event,
                            const UserAction *pressed[CONTROL_BUTTONS_MAX], int *pressed_count)
{
    ControlDevice *device = find(devices, event->number);
    const DeviceState *state = event->state;
    *pressed_count = 0;
    if (!device)
        return false;
    const uint32_t down = state->buttons & ~device->state.buttons;
    for (int bit = 0; bit < CONTROL_BUTTONS_MAX; bit++) {
        const UserAction *action =
            down >> bit & 1 ? mapping_button(&device->map, device->vendor, device->product, bit) : NULL;
        if (action)
            pressed[(*pressed_count)++] = action;
    }
    device->state = *state;
    device->silent = 0;
    if (state->has_motion)
        take_motion(devices, device);
    return true;
}
