#include "app/hand_post.h"

#include "sim/box_motion.h"
#include "sim/stage.h"

#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LATENCIES_MAX = 4096 };

typedef struct PostDevice {
    int number; /* 0: none is here */
    DeviceFamily family;
    uint16_t vendor, product;
    char name[64], problem[NEWS_WORDS_SIZE];
    DeviceState state;
    DeviceMap map;
    Orientation orientation;
} PostDevice;

struct HandPost {
    pthread_mutex_t lock;
    Mapping mapping;
    void (*wake)(void);
    HandSend *send; /* NULL: closed */
    void *user;
    Hand hand;
    HandInput own;      /* of the window at its last look, without what counts once */
    double box_size[3]; /* all 0: the window has not looked yet */
    double looked_ms;   /* wall time of the last update */
    PostDevice devices[HAND_POST_DEVICES_MAX];
    HandNews news;
    uint64_t reports;
    size_t latencies;
    float latency_ms[LATENCIES_MAX]; /* a ring */
};

HandPost *hand_post_create(const Mapping *mapping, void (*wake)(void))
{
    HandPost *post = calloc(1, sizeof *post);
    if (!post)
        return NULL;
    post->mapping = *mapping;
    post->wake = wake;
    post->hand = hand_at_rest();
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
    post->hand = hand_at_rest();
    post->own = (HandInput){.dt = 0};
    memset(post->box_size, 0, sizeof post->box_size);
    post->news.sent_count = 0; /* numbers of the scene before */
    pthread_mutex_unlock(&post->lock);
}

void hand_post_close(HandPost *post)
{
    pthread_mutex_lock(&post->lock);
    post->send = NULL;
    pthread_mutex_unlock(&post->lock);
}

static bool in_use(const PostDevice *device)
{
    return device->number > 0 && !device->problem[0];
}

/* The devices' turns one on top of the other, in the order in which they came. */
static void add_turn(const PostDevice *device, HandInput *sum)
{
    double turned[4], of_box[4];
    if (!device->map.pose || !device->orientation.begun)
        return;
    orientation_turned(&device->orientation, turned);
    mapping_pose(&device->map, turned, of_box);
    if (sum->turned[3] == 0 && sum->turned[0] == 0 && sum->turned[1] == 0 && sum->turned[2] == 0)
        memcpy(sum->turned, of_box, sizeof of_box);
    else
        quat_multiply(of_box, sum->turned, sum->turned);
}

/* What the window last said and the devices say, together. */
static HandInput sum_up(const HandPost *post, double camera[3])
{
    HandInput sum = post->own;
    for (int i = 0; i < HAND_POST_DEVICES_MAX; i++) {
        if (!in_use(&post->devices[i]))
            continue;
        mapping_add(&post->devices[i].map, &post->devices[i].state, &sum, camera);
        add_turn(&post->devices[i], &sum);
    }
    return sum;
}

/* Sends where the box shall be now; 0: nothing new, or nobody to send it to. */
static uint64_t update(HandPost *post)
{
    const double now = wall_ms(), dt = fmin(1e-3 * (now - post->looked_ms), HAND_DT_MOST);
    double camera[3] = {0};
    BoxTarget target;
    post->looked_ms = now;
    HandInput sum = sum_up(post, camera);
    if (!post->send || post->box_size[0] == 0)
        return 0;
    sum.dt = dt;
    for (int k = 0; k < 3; k++)
        post->news.camera[k] += camera[k] * dt;
    return hand_update(&post->hand, &sum, post->box_size, &target) ? post->send(post->user, &target) : 0;
}

uint64_t hand_post_look(HandPost *post, const HandInput *input, const double box_size[3], HandNews *news)
{
    pthread_mutex_lock(&post->lock);
    post->own = *input;
    memcpy(post->box_size, box_size, sizeof post->box_size);
    const uint64_t number = update(post);
    memset(post->own.move_drag, 0, sizeof post->own.move_drag);
    memset(post->own.turn_drag, 0, sizeof post->own.turn_drag);
    *news = post->news;
    post->news = (HandNews){.command_count = 0};
    pthread_mutex_unlock(&post->lock);
    return number;
}

static void level_devices(HandPost *post)
{
    for (int i = 0; i < HAND_POST_DEVICES_MAX; i++)
        orientation_neutral(&post->devices[i].orientation);
}

void hand_post_neutral(HandPost *post)
{
    pthread_mutex_lock(&post->lock);
    level_devices(post);
    pthread_mutex_unlock(&post->lock);
}

void hand_post_home(HandPost *post)
{
    pthread_mutex_lock(&post->lock);
    level_devices(post);
    hand_home(&post->hand);
    pthread_mutex_unlock(&post->lock);
}

void hand_post_let_go(HandPost *post, const BoxTarget *now)
{
    double camera[3];
    pthread_mutex_lock(&post->lock);
    const HandInput still = sum_up(post, camera);
    hand_let_go(&post->hand, now, &still, post->box_size);
    pthread_mutex_unlock(&post->lock);
}

bool hand_post_claims(HandPost *post, uint16_t vendor, uint16_t product)
{
    bool claims = false;
    pthread_mutex_lock(&post->lock);
    for (int i = 0; i < HAND_POST_DEVICES_MAX; i++) {
        const PostDevice *device = &post->devices[i];
        claims = claims || (in_use(device) && device->vendor == vendor && device->product == product);
    }
    pthread_mutex_unlock(&post->lock);
    return claims;
}

static void show_device(const PostDevice *device, HandDevice *out)
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
        if (post->devices[i].number > 0)
            show_device(&post->devices[i], &devices[count++]);
    pthread_mutex_unlock(&post->lock);
    return count;
}

void hand_post_tune(HandPost *post, int number, double gain, double dead_zone)
{
    pthread_mutex_lock(&post->lock);
    for (int i = 0; i < HAND_POST_DEVICES_MAX; i++) {
        PostDevice *device = &post->devices[i];
        if (device->number != number || number <= 0)
            continue;
        device->map.gain = gain;
        device->map.dead_zone = dead_zone;
        *mapping_of(&post->mapping, device->family, device->vendor, device->product) = device->map;
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

/* From here on: what happens on the devices' thread. */

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

static PostDevice *find(HandPost *post, int number)
{
    for (int i = 0; i < HAND_POST_DEVICES_MAX; i++)
        if (post->devices[i].number == number)
            return &post->devices[i];
    return NULL;
}

/* Closes the gap, so that the order stays that of coming. */
static void forget(HandPost *post, const PostDevice *device)
{
    const size_t at = (size_t)(device - post->devices);
    memmove(&post->devices[at], &post->devices[at + 1],
            (HAND_POST_DEVICES_MAX - 1 - at) * sizeof *post->devices);
    post->devices[HAND_POST_DEVICES_MAX - 1] = (PostDevice){.number = 0};
}

/* One that was refused and is plugged in again, or may be opened now, is no longer the refused one. */
static void forget_refused(HandPost *post, const DeviceEvent *event)
{
    for (int i = HAND_POST_DEVICES_MAX - 1; i >= 0; i--) {
        const PostDevice *device = &post->devices[i];
        if (device->number > 0 && device->problem[0] && device->vendor == event->vendor &&
            device->product == event->product)
            forget(post, device);
    }
}

static bool add_device(HandPost *post, const DeviceEvent *event)
{
    forget_refused(post, event);
    PostDevice *device = find(post, 0);
    if (!device) {
        say(post, true, "%s is one device too many; unplug another one", event->name);
        return false;
    }
    *device = (PostDevice){.number = event->number,
                           .family = event->family,
                           .vendor = event->vendor,
                           .product = event->product,
                           .map = *mapping_of(&post->mapping, event->family, event->vendor, event->product),
                           .orientation = orientation_start()};
    snprintf(device->name, sizeof device->name, "%s", event->name);
    if (event->kind == DEVICE_REFUSED)
        snprintf(device->problem, sizeof device->problem, "%s", event->problem);
    return true;
}

/* The box stays where it was last sent, though nothing holds it there any more. */
static void remove_device(HandPost *post, PostDevice *device)
{
    double camera[3];
    say(post, false, "%s is gone; the box stays where it is", device->name);
    forget(post, device);
    const HandInput still = sum_up(post, camera);
    const BoxTarget told = post->hand.told;
    if (post->box_size[0] > 0)
        hand_let_go(&post->hand, &told, &still, post->box_size);
}

static void press_buttons(HandPost *post, const PostDevice *device, uint32_t pressed)
{
    for (int bit = 0; bit < 32; bit++) {
        const PlayCommand command = pressed >> bit & 1
                                        ? mapping_button(&device->map, device->vendor, device->product, bit)
                                        : PLAY_NONE;
        if (command != PLAY_NONE && post->news.command_count < NEWS_COMMANDS_MAX)
            post->news.commands[post->news.command_count++] = command;
    }
}

static void take_report(HandPost *post, PostDevice *device, const DeviceState *state)
{
    press_buttons(post, device, state->buttons & ~device->state.buttons);
    device->state = *state;
    if (state->has_motion)
        orientation_update(&device->orientation, state->time, state->angular_velocity, state->acceleration);
    post->reports++;
}

static void sent(HandPost *post, double when_ms, uint64_t number)
{
    HandNews *news = &post->news;
    if (news->sent_count == NEWS_SENT_MAX) /* a picture lasted long: the oldest tell least */
        memmove(&news->sent[0], &news->sent[1], (size_t)--news->sent_count * sizeof *news->sent);
    news->sent[news->sent_count].when_ms = when_ms;
    news->sent[news->sent_count++].number = number;
    post->latency_ms[post->latencies++ % LATENCIES_MAX] = (float)(wall_ms() - when_ms);
}

static void hear(HandPost *post, const DeviceEvent *event, double when_ms)
{
    PostDevice *device = find(post, event->number);
    switch (event->kind) {
    case DEVICE_PLUGGED:
        if (add_device(post, event))
            say(post, false, "%s is in your hand", event->name);
        break;
    case DEVICE_REFUSED:
        if (add_device(post, event))
            say(post, true, "%s: %s", event->name, event->problem);
        break;
    case DEVICE_UNPLUGGED:
        if (device)
            remove_device(post, device);
        break;
    case DEVICE_REPORTED:
        if (!device)
            break;
        take_report(post, device, event->state);
        const uint64_t number = update(post);
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
