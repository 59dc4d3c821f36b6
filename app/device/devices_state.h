/* Inside the devices: what their threads share. */
#ifndef SLOSH_DEVICES_STATE_H
#define SLOSH_DEVICES_STATE_H

#include "app/device/device_trouble.h"
#include "app/device/devices.h"
#include "app/device/report.h"
#include "app/device/report_log.h"

#include <pthread.h>
#include <stdatomic.h>

/* One that is there, or was: replayed, or read by a thread of its own. */
typedef struct Device {
    struct Device *next;
    struct Devices *devices;
    int number, log_number; /* as told; in the file that is recorded, 0: none */
    ReportFormat format;
    bool bluetooth;
    DeviceState state;
    bool plugged; /* told so, and not yet that it is gone */
    /* what only a real one has */
    char path[HID_PATH_SIZE];
    void *handle;      /* NULL: not opened; else the thread's */
    int denials;       /* how often it could not be opened */
    bool seen;         /* at the last look */
    bool gone;         /* its thread shall end and tell nothing more */
    bool began, ended; /* its thread */
    pthread_t thread;
} Device;

struct Devices {
    DevicesSetup setup;
    HidPort port;
    ReportLog log;        /* what is replayed */
    Device *replayed;     /* as many as a recording may have; NULL: it is no replay */
    size_t next;          /* entry of `log`; its count: what is left is unplugged; more: all is told */
    pthread_mutex_t lock; /* of all below and of the devices' fields, held while the listener is called */
    pthread_cond_t wake;  /* stopping, or a thread has ended */
    bool stopping;
    bool left; /* devices_stop has returned before all threads ended: the last one frees */
    int threads, numbers;
    Device *list;
    bool began, ended; /* the thread that looks, or replays */
    pthread_t thread;
    atomic_bool played;
};

/* All with the lock held; nothing is told once stopping is set. */
void devices_tell(Device *device, DeviceEventKind kind, const char *problem);
void devices_plugged(Device *device);
void devices_reported(Device *device, const uint8_t *bytes, size_t size, double time);
void devices_unplugged(Device *device);

/* Waits until that time of wall_ms, or until stopping. */
void devices_wait(Devices *devices, double until_ms);

/* Threads. A thread ends with devices_finish, which takes the lock, marks *ended, and frees all where it is
   the last of those that were left. */
bool devices_spawn(Devices *devices, pthread_t *thread, void *(*run)(void *), void *data);
void devices_finish(Devices *devices, bool *ended);

/* The threads that look for what is plugged in, or replay; `data` is the struct Devices. */
void *devices_look(void *data);
void *devices_replay(void *data);

#endif
