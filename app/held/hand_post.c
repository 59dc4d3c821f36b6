#include "app/held/hand_post.h"

#include "sim/base/stage.h"

#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LATENCIES_MAX = 4096 };

struct HandPost {
    pthread_mutex_t lock;
    void (*wake)(void);
    HandSend *send; /* NULL: closed */
    void *user;
    HeldDevices held; /* `own`: the window's last input, without parts that count once; box_size 0: before
                         the first look */
    double looked_ms; /* wall time of the last update */
    HandNews news;
    uint64_t reports;
    size_t latencies;
    float latency_ms[LATENCIES_MAX]; /* ring buffer */
};

HandPost *hand_post_create(const Mapping *mapping, void (*wake)(void))
{
    HandPost *post = calloc(1, sizeof *post);
    if (!post)
        return NULL;
    post->wake = wake;
    held_devices_start(&post->held, mapping);
    pthread_mutex_init(&post->lock, NULL);
    return post;
}

void hand_post_destroy(HandPost *post)
{
    if (!post)
        return;
    pthread_mutex_destroy(&post->lock);
    free(post);
}

void hand_post_open(HandPost *post, HandSend *send, void *user)
{
    pthread_mutex_lock(&post->lock);
    post->send = send;
    post->user = user;
    post->held.hand = hand_at_rest();
    post->held.own = (HandInput){.dt = 0};
    memset(post->held.box_size, 0, sizeof post->held.box_size);
    post->news.sent_count = 0; /* numbers of the scene before */
    pthread_mutex_unlock(&post->lock);
}

void hand_post_close(HandPost *post)
{
    pthread_mutex_lock(&post->lock);
    post->send = NULL;
    pthread_mutex_unlock(&post->lock);
}

/* Sends the present target; returns 0 if nothing is new, or nobody to receive it. */
static uint64_t update(HandPost *post)
{
    const double now = wall_ms(), dt = fmin(1e-3 * (now - post->looked_ms), HAND_DT_MOST);
    BoxTarget target;
    post->looked_ms = now;
    if (!post->send || post->held.box_size[0] == 0 ||
        !held_devices_update(&post->held, dt, post->news.camera, &target))
        return 0;
    return post->send(post->user, &target);
}

uint64_t hand_post_look(HandPost *post, const HandInput *input, const double box_size[3], HandNews *news)
{
    pthread_mutex_lock(&post->lock);
    HandInput *own = &post->held.own;
    *own = *input;
    memcpy(post->held.box_size, box_size, sizeof post->held.box_size);
    const uint64_t number = update(post);
    memset(own->move_drag, 0, sizeof own->move_drag);
    memset(own->turn_drag, 0, sizeof own->turn_drag);
    *news = post->news;
    news->target = post->held.hand.told;
    post->news = (HandNews){.command_count = 0};
    pthread_mutex_unlock(&post->lock);
    return number;
}

void hand_post_neutral(HandPost *post)
{
    pthread_mutex_lock(&post->lock);
    held_devices_neutral(&post->held);
    pthread_mutex_unlock(&post->lock);
}

void hand_post_home(HandPost *post)
{
    pthread_mutex_lock(&post->lock);
    held_devices_home(&post->held);
    pthread_mutex_unlock(&post->lock);
}

void hand_post_let_go(HandPost *post, const BoxTarget *now)
{
    pthread_mutex_lock(&post->lock);
    held_devices_let_go(&post->held, now);
    pthread_mutex_unlock(&post->lock);
}

void hand_post_follow(HandPost *post, const BoxTarget *target)
{
    pthread_mutex_lock(&post->lock);
    held_devices_follow(&post->held, target);
    pthread_mutex_unlock(&post->lock);
}

bool hand_post_claims(HandPost *post, uint16_t vendor, uint16_t product)
{
    bool claims = false;
    pthread_mutex_lock(&post->lock);
    for (int i = 0; i < HAND_POST_DEVICES_MAX; i++) {
        const HeldDevice *device = &post->held.list[i];
        claims =
            claims || (held_device_in_use(device) && device->vendor == vendor && device->product == product);
    }
    pthread_mutex_unlock(&post->lock);
    return claims;
}

static void show_device(const HeldDevice *device, HandDevice *out)
{
    *out = (HandDevice){.number = device->number,
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

int hand_post_devices(HandPost *post, HandDevice devices[HAND_POST_DEVICES_MAX])
{
    int count = 0;
    pthread_mutex_lock(&post->lock);
    for (int i = 0; i < HAND_POST_DEVICES_MAX; i++)
        if (post->held.list[i].number > 0)
            show_device(&post->held.list[i], &devices[count++]);
    pthread_mutex_unlock(&post->lock);
    return count;
}

void hand_post_tune(HandPost *post, int number, double gain, double dead_zone)
{
    pthread_mutex_lock(&post->lock);
    for (int i = 0; i < HAND_POST_DEVICES_MAX; i++) {
        HeldDevice *device = &post->held.list[i];
        if (device->number != number || number <= 0)
            continue;
        device->map.gain = gain;
        device->map.dead_zone = dead_zone;
        *mapping_of(&post->held.mapping, device->family, device->vendor, device->product) = device->map;
    }
    pthread_mutex_unlock(&post->lock);
}

uint64_t hand_post_reports(HandPost *post)
{
    pthread_mutex_lock(&post->lock);
    const uint64_t reports = post->reports;
    pthread_mutex_unlock(&post->lock);
    return reports;
}

static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

double hand_post_latency(HandPost *post, double fraction)
{
    float sorted[LATENCIES_MAX];
    pthread_mutex_lock(&post->lock);
    const size_t count = post->latencies < LATENCIES_MAX ? post->latencies : LATENCIES_MAX;
    memcpy(sorted, post->latency_ms, count * sizeof *sorted);
    pthread_mutex_unlock(&post->lock);
    qsort(sorted, count, sizeof *sorted, ascending);
    return count ? (double)sorted[(size_t)(fraction * (double)(count - 1) + 0.5)] : 0;
}

/* From here on: functions of the devices' thread. */

static void say(HandPost *post, bool wrong, const char *format, ...) __attribute__((format(printf, 3, 4)));

static void say(HandPost *post, bool wrong, const char *format, ...)
{
    HandNews *news = &post->news;
    if (news->words_count == NEWS_WORDS_MAX)
        return;
    va_list arguments;
    va_start(arguments, format);
    news->words[news->words_count].wrong = wrong;
    vsnprintf(news->words[news->words_count++].text, NEWS_WORDS_SIZE, format, arguments);
    va_end(arguments);
}

static void add_device(HandPost *post, const DeviceEvent *event)
{
    const bool refused = event->kind == DEVICE_REFUSED;
    if (!held_devices_add(&post->held, event))
        say(post, true, "%s is one device too many; unplug another one", event->name);
    else if (refused)
        say(post, true, "%s: %s", event->name, event->problem);
    else
        say(post, false, "%s is in your hand", event->name);
}

static void remove_device(HandPost *post, int number)
{
    HeldDevice gone;
    if (held_devices_remove(&post->held, number, &gone))
        say(post, false, "%s is gone%s", gone.name,
            held_device_in_use(&gone) ? "; the box stays where it is" : "");
}

/* Returns false if the device is not held. */
static bool take_report(HandPost *post, const DeviceEvent *event)
{
    PlayCommand pressed[HELD_BUTTONS_MAX];
    int count;
    if (!held_devices_report(&post->held, event, pressed, &count))
        return false;
    HandNews *news = &post->news;
    for (int i = 0; i < count && news->command_count < NEWS_COMMANDS_MAX; i++)
        news->commands[news->command_count++] = pressed[i];
    post->reports++;
    return true;
}

static void sent(HandPost *post, double when_ms, uint64_t number)
{
    HandNews *news = &post->news;
    if (news->sent_count == NEWS_SENT_MAX) /* after a long picture: drop the oldest */
        memmove(&news->sent[0], &news->sent[1], (size_t)--news->sent_count * sizeof *news->sent);
    news->sent[news->sent_count].when_ms = when_ms;
    news->sent[news->sent_count++].number = number;
    post->latency_ms[post->latencies++ % LATENCIES_MAX] = (float)(wall_ms() - when_ms);
}

static void hear(HandPost *post, const DeviceEvent *event, double when_ms)
{
    uint64_t number;
    switch (event->kind) {
    case DEVICE_PLUGGED:
    case DEVICE_REFUSED:
        add_device(post, event);
        break;
    case DEVICE_UNPLUGGED:
        remove_device(post, event->number);
        break;
    case DEVICE_REPORTED:
        number = take_report(post, event) ? update(post) : 0;
        if (number)
            sent(post, when_ms, number);
        break;
    }
}

void hand_post_hear(void *user, const DeviceEvent *event)
{
    HandPost *post = user;
    const double when_ms = wall_ms();
    pthread_mutex_lock(&post->lock);
    hear(post, event, when_ms);
    const HandNews *news = &post->news;
    const bool wanted = news->command_count > 0 || news->words_count > 0 || news->camera[0] != 0 ||
                        news->camera[1] != 0 || news->camera[2] != 0;
    pthread_mutex_unlock(&post->lock);
    if (wanted && post->wake)
        post->wake();
}
