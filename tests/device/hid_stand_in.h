/* A stand-in for hidapi: devices that tests plug in, unplug and let misbehave. */
#ifndef SLOSH_TESTS_HID_STAND_IN_H
#define SLOSH_TESTS_HID_STAND_IN_H

#include "tests/device/report_fixture.h"

#include "app/input/device/device.h"
#include "sim/world.h"

#include <pthread.h>
#include <stdio.h>
#include <time.h>

enum { STAND_IN_DEVICES = 4, STAND_IN_QUEUE = 64, STAND_IN_FEATURES = 8 };

typedef struct StandInDevice {
    HidInfo info;
    bool present, twice; /* twice: enumerated as two collections of one path */
    int refusal;         /* -1: opens; else HidRefusal */
    bool broken;         /* reads fail */
    bool stalled;        /* reads do not come back, whatever the time */
    bool hasty;          /* reads come back at once with nothing */
    int lie;             /* more than 0: the length that the next read claims */
    Report queue[STAND_IN_QUEUE];
    int queued;
    Report feature;  /* result of get_feature for the id */
    int feature_lie; /* more than 0: the length it claims */
    int damaged;     /* how often its last byte is wrong */
    int asked_count; /* ids that were asked for */
    uint8_t asked[STAND_IN_FEATURES];
    int opens, closes, reads;
} StandInDevice;

typedef struct StandIn {
    pthread_mutex_t lock;
    pthread_cond_t wake;
    StandInDevice devices[STAND_IN_DEVICES];
    int answer; /* what enumerate returns in place of a number; 0: the number */
    int looks;
} StandIn;

static StandIn stand_in = {.lock = PTHREAD_MUTEX_INITIALIZER, .wake = PTHREAD_COND_INITIALIZER};

static int stand_in_enumerate(void *self, HidInfo *out, int max)
{
    StandIn *all = self;
    int count = 0;
    pthread_mutex_lock(&all->lock);
    for (int i = 0; i < STAND_IN_DEVICES; i++)
        for (int k = 0; all->devices[i].present && k <= all->devices[i].twice && count < max; k++)
            out[count++] = all->devices[i].info;
    count = all->answer ? all->answer : count;
    all->looks++;
    pthread_mutex_unlock(&all->lock);
    return count;
}

static void *stand_in_open(void *self, const char *path, HidRefusal *why, char reason[HID_REASON_SIZE])
{
    StandIn *all = self;
    void *handle = NULL;
    pthread_mutex_lock(&all->lock);
    for (int i = 0; i < STAND_IN_DEVICES; i++) {
        StandInDevice *device = &all->devices[i];
        if (!device->present || strcmp(device->info.path, path) != 0)
            continue;
        *why = device->refusal < 0 ? HID_FAILED : (HidRefusal)device->refusal;
        snprintf(reason, HID_REASON_SIZE, "out of order");
        handle = device->refusal < 0 ? device : NULL;
        device->opens += handle != NULL;
    }
    pthread_mutex_unlock(&all->lock);
    return handle;
}

/* With the lock held. */
static int stand_in_take(StandInDevice *device, uint8_t *bytes, size_t size)
{
    const Report report = device->queue[0];
    memmove(device->queue, device->queue + 1, sizeof device->queue - sizeof *device->queue);
    device->queued--;
    memcpy(bytes, report.bytes, report.size < size ? report.size : size);
    const int length = device->lie ? device->lie : (int)report.size;
    device->lie = 0;
    return length;
}

static int stand_in_read(void *handle, uint8_t *bytes, size_t size, int timeout_ms)
{
    StandInDevice *device = handle;
    struct timespec until;
    int result = 0;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += timeout_ms * 1000000L;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    pthread_mutex_lock(&stand_in.lock);
    device->reads++;
    while (device->stalled)
        pthread_cond_wait(&stand_in.wake, &stand_in.lock);
    while (device->queued == 0 && !device->broken && !device->stalled && !device->hasty && result == 0)
        result = pthread_cond_timedwait(&stand_in.wake, &stand_in.lock, &until);
    result = device->broken ? -1 : device->queued > 0 ? stand_in_take(device, bytes, size) : 0;
    pthread_mutex_unlock(&stand_in.lock);
    return result;
}

static int stand_in_feature(void *handle, uint8_t *bytes, size_t size)
{
    StandInDevice *device = handle;
    int result = -1;
    pthread_mutex_lock(&stand_in.lock);
    if (device->asked_count < STAND_IN_FEATURES)
        device->asked[device->asked_count++] = bytes[0];
    if (device->feature.size > 0 && bytes[0] == device->feature.bytes[0] && device->feature.size <= size) {
        memcpy(bytes, device->feature.bytes, device->feature.size);
        bytes[device->feature.size - 1] ^= device->damaged-- > 0;
        result = device->feature_lie ? device->feature_lie : (int)device->feature.size;
    }
    pthread_mutex_unlock(&stand_in.lock);
    return result;
}

static void stand_in_close(void *handle)
{
    StandInDevice *device = handle;
    pthread_mutex_lock(&stand_in.lock);
    device->closes++;
    pthread_mutex_unlock(&stand_in.lock);
}

static const HidPort stand_in_port = {.self = &stand_in,
                                      .look_ms = 20,
                                      .enumerate = stand_in_enumerate,
                                      .open = stand_in_open,
                                      .read = stand_in_read,
                                      .get_feature = stand_in_feature,
                                      .close = stand_in_close};

/* The following functions take the lock. */

static inline StandInDevice *plug(int place, uint16_t vendor, uint16_t product, bool bluetooth)
{
    StandInDevice *device = &stand_in.devices[place];
    pthread_mutex_lock(&stand_in.lock);
    *device = (StandInDevice){.info = {.vendor = vendor, .product = product, .bluetooth = bluetooth},
                              .present = true,
                              .refusal = -1};
    snprintf(device->info.path, sizeof device->info.path, "/dev/hidraw%d", place);
    pthread_mutex_unlock(&stand_in.lock);
    return device;
}

static inline void push(StandInDevice *device, const Report *report)
{
    pthread_mutex_lock(&stand_in.lock);
    assert_true(device->queued < STAND_IN_QUEUE);
    device->queue[device->queued++] = *report;
    pthread_cond_broadcast(&stand_in.wake);
    pthread_mutex_unlock(&stand_in.lock);
}

#define STAND_IN_SET(field, value)                                                                           \
    do {                                                                                                     \
        pthread_mutex_lock(&stand_in.lock);                                                                  \
        (field) = (value);                                                                                   \
        pthread_cond_broadcast(&stand_in.wake);                                                              \
        pthread_mutex_unlock(&stand_in.lock);                                                                \
    } while (0)

static inline int stand_in_get(const int *field)
{
    pthread_mutex_lock(&stand_in.lock);
    const int value = *field;
    pthread_mutex_unlock(&stand_in.lock);
    return value;
}

static inline void pause_ms(int ms)
{
    nanosleep(&(struct timespec){.tv_sec = ms / 1000, .tv_nsec = ms % 1000 * 1000000L}, NULL);
}

#endif
