/* Internals of the devices, shared by their threads. */
#ifndef SLOSH_DEVICES_STATE_H
#define SLOSH_DEVICES_STATE_H

#include "app/device/device_trouble.h"
#include "app/device/devices.h"
#include "app/device/report.h"
#include "app/device/report_log.h"

#include <pthread.h>
#include <stdatomic.h>

/* A present or past device: replayed, or read by its own thread. */
typedef struct Device {
    struct Device *next;
    struct Devices *devices;
    int number, log_number; /* number for the listener; number in the recorded file, 0: none */
    ReportFormat format;
    bool bluetooth;
    DeviceState state;
    bool plugged; /* reported as plugged in, and not yet as unplugged */
    /* only for real devices: */
    char path[HID_PATH_SIZE];
    void *handle;      /* NULL: not opened; else used by the thread */
    int denials;       /* count of failed attempts to open */
    bool seen;         /* at the last look */
    bool gone;         /* the thread must end and report nothing more */
    bool began, ended; /* state of the thread */
    pthread_t thread;
} Device;

struct Devices {
    DevicesSetup setup;
    HidPort port;
    ReportLog log;        /* the replayed recording */
    Device *replayed;     /* REPORT_LOG_DEVICES_MAX entries; NULL: no replay */
    size_t next;          /* next entry of `log`; its count: unplug the rest; greater: finished */
    pthread_mutex_t lock; /* guards all members below and the devices; held during calls of the listener */
    pthread_cond_t wake;  /* signalled on stop, or at the end of a thread */
    bool stopping;
    bool left; /* devices_stop has returned before all threads ended: the last thread frees everything */
    int threads, numbers;
    Device *list;
    bool began, ended; /* of the thread for looking or replaying */
    pthread_t thread;
    atomic_bool played;
};

/* Call all with the lock held. The listener is not called once stopping is set. */
void devices_tell(Device *device, DeviceEventKind kind, const char *problem);
void devices_plugged(Device *device);
void devices_reported(Device *device, const uint8_t *bytes, size_t size, double time);
void devices_unplugged(Device *device);

/* Waits until a time of wall_ms, or until stopping. */
void devices_wait(Devices *devices, double until_ms);

/* devices_spawn starts a thread. The thread ends with devices_finish, which takes the lock, marks *ended,
   and frees everything after the last thread if devices_stop has returned. */
bool devices_spawn(Devices *devices, pthread_t *thread, void *(*run)(void *), void *data);
void devices_finish(Devices *devices, bool *ended);

/* Threads: search for plugged in devices, or replay; `data` is the struct Devices. */
void *devices_look(void *data);
void *devices_replay(void *data);

#endif
