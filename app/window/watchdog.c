#define _GNU_SOURCE /* POLLRDHUP */
#include "app/base/file.h"
#include "app/base/program.h"
#include "app/files/pictures.h"
#include "app/window/model.h"

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/eventfd.h>
#include <unistd.h>

/* Patience in ms: for the window to notice a lost display, or a signal, as a picture of a software driver
   takes long. Then for the solver to save the session. */
enum { GONE_MS = 400, SIGNAL_MS = 2000, SAVE_MS = 400 };

struct Watchdog {
    pthread_t thread;
    pthread_mutex_t lock;
    Simulator *simulator;
    const char *record;
    int connection, stop; /* file descriptors */
};

bool watchdog_session_path(const char *record, bool unsaved, char path[1024])
{
    if (record)
        snprintf(path, 1024, "%s", record);
    else if (unsaved && interrupt_signal() != SIGINT)
        dated_file_name(path, "recording");
    else
        return false;
    return true;
}

/* Ends the program; the window's thread is left in a call that does not return. */
_Noreturn static void end(Watchdog *guard, bool lost)
{
    char path[1024], words[1200];
    bool ok = !lost;
    pthread_mutex_lock(&guard->lock);
    if (guard->simulator && watchdog_session_path(guard->record, simulator_unsaved(guard->simulator), path)) {
        ok &= simulator_save_last(guard->simulator, path, SAVE_MS, words);
        fprintf(stderr, "%s\n", words);
    }
    if (lost)
        fprintf(stderr, "the display is gone\n");
    if (output_discard_all() > 0) {
        fprintf(stderr, "a video or a picture that was being written is lost\n");
        ok = false;
    }
    _exit(ok ? 0 : EXIT_FAILED);
}

static void *look_after(void *of_guard)
{
    Watchdog *guard = of_guard;
    struct pollfd on[] = {{.fd = guard->stop, .events = POLLIN},
                          {.fd = guard->connection, .events = POLLRDHUP},
                          {.fd = interrupt_descriptor(), .events = POLLIN}};
    while (poll(on, 3, -1) <= 0)
        continue;
    const bool lost = on[1].revents != 0;
    if (on[0].revents == 0 && poll(on, 1, lost ? GONE_MS : SIGNAL_MS) == 0)
        end(guard, lost);
    return NULL;
}

/* Blocks signals in the new thread: the window's thread handles them. */
static bool start_thread(Watchdog *guard)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = pthread_create(&guard->thread, NULL, look_after, guard) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

static void release(Watchdog *guard)
{
    if (guard->stop >= 0)
        close(guard->stop);
    pthread_mutex_destroy(&guard->lock);
    free(guard);
}

Watchdog *watchdog_create(const char *record, int connection)
{
    Watchdog *guard = calloc(1, sizeof *guard);
    if (!guard)
        return NULL;
    pthread_mutex_init(&guard->lock, NULL);
    guard->record = record;
    guard->connection = connection;
    guard->stop = eventfd(0, EFD_CLOEXEC);
    if (guard->stop >= 0 && start_thread(guard))
        return guard;
    release(guard);
    return NULL;
}

void watchdog_watch(Watchdog *guard, Simulator *simulator)
{
    if (!guard)
        return;
    pthread_mutex_lock(&guard->lock);
    guard->simulator = simulator;
    pthread_mutex_unlock(&guard->lock);
}

void watchdog_destroy(Watchdog *guard)
{
    if (!guard)
        return;
    eventfd_write(guard->stop, 1);
    pthread_join(guard->thread, NULL);
    release(guard);
}
