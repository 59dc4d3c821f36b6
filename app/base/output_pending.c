#define _GNU_SOURCE /* getdents64 */
#include "app/base/output_pending.h"

#include <dirent.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { PENDING_MAX = 8 };

static pthread_mutex_t adding = PTHREAD_MUTEX_INITIALIZER; /* the window and the solver's thread save */

/* The only state reachable by a signal handler. */
static struct {
    volatile sig_atomic_t used;
    pid_t owner; /* a child that crashes leaves the files of its parent */
    char temp[OUTPUT_TEMP_SIZE];
} pending[PENDING_MAX];

void output_pending_add(const char *temp)
{
    int i = 0;
    pthread_mutex_lock(&adding);
    while (i < PENDING_MAX && pending[i].used)
        i++;
    if (i < PENDING_MAX) {
        snprintf(pending[i].temp, sizeof pending[i].temp, "%s", temp);
        pending[i].owner = getpid();
        pending[i].used = 1;
    }
    pthread_mutex_unlock(&adding);
}

void output_pending_forget(const char *temp)
{
    pthread_mutex_lock(&adding);
    for (int i = 0; i < PENDING_MAX; i++)
        if (pending[i].used && strcmp(pending[i].temp, temp) == 0)
            pending[i].used = 0;
    pthread_mutex_unlock(&adding);
}

/* Removes one buffer of entries; returns true if any file was removed. */
static bool remove_some(int folder)
{
    _Alignas(struct dirent64) char buffer[4096];
    bool removed = false;
    ssize_t size = getdents64(folder, buffer, sizeof buffer);
    for (ssize_t at = 0; at < size;) {
        const struct dirent64 *entry = (const struct dirent64 *)(buffer + at);
        removed |= unlinkat(folder, entry->d_name, 0) == 0;
        at += entry->d_reclen;
    }
    return removed;
}

/* Uses system calls: opendir allocates memory, which is forbidden in a signal handler. */
void output_remove_folder(const char *path)
{
    int folder = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0)
        return;
    while (remove_some(folder))
        lseek(folder, 0, SEEK_SET);
    close(folder);
    rmdir(path);
}

int output_discard_all(void)
{
    int count = 0;
    for (int i = 0; i < PENDING_MAX; i++) {
        if (!pending[i].used || pending[i].owner != getpid())
            continue;
        count++;
        if (unlink(pending[i].temp) != 0)
            output_remove_folder(pending[i].temp);
    }
    return count;
}
