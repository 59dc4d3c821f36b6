#include "app/input/input.h"

#include "sim/world.h"

#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LATENCIES_MAX = 4096 };

struct BoxControl {
    pthread_mutex_t lock;
    void (*wake)(void);
    BoxControlSend *send; /* NULL: closed */
    void *user;
    ControlDevices held; /* `own`: the window's last input, without parts that count once; box_size 0: before
                         the first look */
    double looked_ms;    /* wall time of the last update */
    BoxControlNews news;
    uint64_t reports;
    size_t latencies;
    float latency_ms[LATENCIES_MAX]; /* ring buffer */
};

BoxControl *box_control_create(const Mapping *mapping, void (*wake)(void))
{
    BoxControl *control = calloc(1, sizeof *control);
    if (!control)
        return NULL;
    control->wake = wake;
    control_devices_start(&control->held, mapping);
    pthread_mutex_init(&control->lock, NULL);
    return control;
}

void box_control_destroy(BoxControl *control)
{
    if (!control)
        return;
    pthread_mutex_destroy(&control->lock);
    free(control);
}

void box_control_open(BoxControl *control, BoxControlSend *send, void *user)
{
    pthread_mutex_lock(&control->lock);
    control->send = send;
    control->user = user;
    control->held.hand = hand_at_rest();
    control->held.own = (HandInput){.dt = 0};
    memset(control->held.box_size, 0, sizeof control->held.box_size);
    control->news.sent_count = 0; /* numbers of the scene before */
    pthread_mutex_unlock(&control->lock);
}

void box_control_close(BoxControl *control)
{
    pthread_mutex_lock(&control->lock);
    control->send = NULL;
    pthread_mutex_unlock(&control->lock);
}

/* Sends the present target; returns 0 if nothing is new, or nobody to receive it. */
static uint64_t update(BoxControl *control)
{
    const double now = wall_ms(), dt = fmin(1e-3 * (now - control->looked_ms), HAND_DT_MOST);
    BoxTarget target;
    control->looked_ms = now;
    if (!control->send || control->held.box_size[0] == 0 ||
        !control_devices_update(&control->held, dt, control->news.camera, &target))
        return 0;
    return control->send(control->user, &target);
}

uint64_t box_control_update(BoxControl *control, const HandInput *input, const double box_size[3],
                            BoxControlNews *news)
{
    pthread_mutex_lock(&control->lock);
    HandInput *own = &control->held.own;
    *own = *input;
    memcpy(control->held.box_size, box_size, sizeof control->held.box_size);
    const uint64_t number = update(control);
    memset(own->move_drag, 0, sizeof own->move_drag);
    memset(own->turn_drag, 0, sizeof own->turn_drag);
    *news = control->news;
    news->target = control->held.hand.sent;
    control->news = (BoxControlNews){.action_count = 0};
    pthread_mutex_unlock(&control->lock);
    return number;
}

void box_control_neutral(BoxControl *control)
{
    pthread_mutex_lock(&control->lock);
    control_devices_neutral(&control->held);
    pthread_mutex_unlock(&control->lock);
}

void box_control_home(BoxControl *control)
{
    pthread_mutex_lock(&control->lock);
    control_devices_home(&control->held);
    pthread_mutex_unlock(&control->lock);
}

void box_control_release(BoxControl *control, const BoxTarget *now)
{
    pthread_mutex_lock(&control->lock);
    control_devices_release(&control->held, now);
    pthread_mutex_unlock(&control->lock);
}

void box_control_set_target(BoxControl *control, const BoxTarget *target)
{
    pthread_mutex_lock(&control->lock);
    control_devices_set_target(&control->held, target);
    pthread_mutex_unlock(&control->lock);
}

bool box_control_uses(BoxControl *control, uint16_t vendor, uint16_t product)
{
    bool claims = false;
    pthread_mutex_lock(&control->lock);
    for (int i = 0; i < BOX_CONTROL_DEVICES_MAX; i++) {
        const ControlDevice *device = &control->held.list[i];
        claims = claims ||
                 (control_device_in_use(device) && device->vendor == vendor && device->product == product);
    }
    pthread_mutex_unlock(&control->lock);
    return claims;
}

static void show_device(const ControlDevice *device, BoxControlDevice *out)
{
    *out = (BoxControlDevice){.number = device->number,
                              .family = device->family,
                              .vendor = device->vendor,
                              .product = device->product,
                              .state = device->state,
                              .map = device->map,
                              .has_pose = device->orientation.begun,
                              .resting = device->orientation.resting};
    memcpy(out->name, device->name, sizeof out->name);
    memcpy(out->problem, device->problem, sizeof out->problem);
    orientation_turned(&device->orientation, out->turned);
    orientation_down(&device->orientation, out->down);
    mapping_axis_values(device->family, &device->state, out->axes);
}

int box_control_devices(BoxControl *control, BoxControlDevice devices[BOX_CONTROL_DEVICES_MAX])
{
    int count = 0;
    pthread_mutex_lock(&control->lock);
    for (int i = 0; i < BOX_CONTROL_DEVICES_MAX; i++)
        if (control->held.list[i].number > 0)
            show_device(&control->held.list[i], &devices[count++]);
    pthread_mutex_unlock(&control->lock);
    return count;
}

void box_control_tune(BoxControl *control, int number, double gain, double dead_zone)
{
    pthread_mutex_lock(&control->lock);
    for (int i = 0; i < BOX_CONTROL_DEVICES_MAX; i++) {
        ControlDevice *device = &control->held.list[i];
        if (device->number != number || number <= 0)
            continue;
        device->map.gain = gain;
        device->map.dead_zone = dead_zone;
        *mapping_of(&control->held.mapping, device->family, device->vendor, device->product) = device->map;
    }
    pthread_mutex_unlock(&control->lock);
}

uint64_t box_control_reports(BoxControl *control)
{
    pthread_mutex_lock(&control->lock);
    const uint64_t reports = control->reports;
    pthread_mutex_unlock(&control->lock);
    return reports;
}

static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

double box_control_latency(BoxControl *control, double fraction)
{
    float sorted[LATENCIES_MAX];
    pthread_mutex_lock(&control->lock);
    const size_t count = control->latencies < LATENCIES_MAX ? control->latencies : LATENCIES_MAX;
    memcpy(sorted, control->latency_ms, count * sizeof *sorted);
    pthread_mutex_unlock(&control->lock);
    qsort(sorted, count, sizeof *sorted, ascending);
    return count ? (double)sorted[(size_t)(fraction * (double)(count - 1) + 0.5)] : 0;
}

/* From here on: functions of the devices' thread. */

static void say(BoxControl *control, bool wrong, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void say(BoxControl *control, bool wrong, const char *format, ...)
{
    BoxControlNews *news = &control->news;
    if (news->words_count == BOX_CONTROL_MESSAGES_MAX)
        return;
    va_list arguments;
    va_start(arguments, format);
    news->words[news->words_count].wrong = wrong;
    vsnprintf(news->words[news->words_count++].text, BOX_CONTROL_MESSAGE_SIZE, format, arguments);
    va_end(arguments);
}

static void add_device(BoxControl *control, const DeviceEvent *event)
{
    const bool refused = event->kind == DEVICE_REFUSED;
    if (!control_devices_add(&control->held, event))
        say(control, true, "%s is one device too many; unplug another one", event->name);
    else if (refused)
        say(control, true, "%s: %s", event->name, event->problem);
    else
        say(control, false, "%s is in your hand", event->name);
}

static void remove_device(BoxControl *control, int number)
{
    ControlDevice gone;
    if (control_devices_remove(&control->held, number, &gone))
        say(control, false, "%s is gone%s", gone.name,
            control_device_in_use(&gone) ? "; the box stays where it is" : "");
}

/* Returns false if the device is not held. */
static bool take_report(BoxControl *control, const DeviceEvent *event)
{
    const UserAction *pressed[CONTROL_BUTTONS_MAX];
    int count;
    if (!control_devices_report(&control->held, event, pressed, &count))
        return false;
    BoxControlNews *news = &control->news;
    for (int i = 0; i < count && news->action_count < BOX_CONTROL_ACTIONS_MAX; i++)
        news->actions[news->action_count++] = pressed[i];
    control->reports++;
    return true;
}

static void sent(BoxControl *control, double when_ms, uint64_t number)
{
    BoxControlNews *news = &control->news;
    if (news->sent_count == BOX_CONTROL_SENT_MAX) /* after a long picture: drop the oldest */
        memmove(&news->sent[0], &news->sent[1], (size_t)--news->sent_count * sizeof *news->sent);
    news->sent[news->sent_count].when_ms = when_ms;
    news->sent[news->sent_count++].number = number;
    control->latency_ms[control->latencies++ % LATENCIES_MAX] = (float)(wall_ms() - when_ms);
}

static void hear(BoxControl *control, const DeviceEvent *event, double when_ms)
{
    uint64_t number;
    switch (event->kind) {
    case DEVICE_PLUGGED:
    case DEVICE_REFUSED:
        add_device(control, event);
        break;
    case DEVICE_UNPLUGGED:
        remove_device(control, event->number);
        break;
    case DEVICE_REPORTED:
        number = take_report(control, event) ? update(control) : 0;
        if (number)
            sent(control, when_ms, number);
        break;
    }
}

void box_control_device_event(void *user, const DeviceEvent *event)
{
    BoxControl *control = user;
    const double when_ms = wall_ms();
    pthread_mutex_lock(&control->lock);
    hear(control, event, when_ms);
    const BoxControlNews *news = &control->news;
    const bool wanted = news->action_count > 0 || news->words_count > 0 || news->camera[0] != 0 ||
                        news->camera[1] != 0 || news->camera[2] != 0;
    pthread_mutex_unlock(&control->lock);
    if (wanted && control->wake)
        control->wake();
}
