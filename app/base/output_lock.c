#define _GNU_SOURCE /* F_OFD_SETLK */
#include "app/base/output_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void tell_unguarded(const char *path, int reason)
{
    static bool told;
    if (!told)
        fprintf(
            stderr,
            "%s: cannot be locked here (%s): another slosh that writes the same file will not be noticed\n",
            path, strerror(reason));
    told = true;
}

/* True if the open file still has the name. */
static bool is_at(int file, const char *path)
{
    struct stat own, there;
    return fstat(file, &own) == 0 && stat(path, &there) == 0 && own.st_dev == there.st_dev &&
           own.st_ino == there.st_ino;
}

/* Opens the file; a read-only file gets a read lock, which only blocks writers. */
static int open_file(const char *path, short *kind)
{
    *kind = F_WRLCK;
    const int file = open(path, O_RDWR | O_CLOEXEC);
    if (file >= 0 || (errno != EACCES && errno != EPERM && errno != EROFS))
        return file;
    *kind = F_RDLCK;
    return open(path, O_RDONLY | O_CLOEXEC);
}

/* Returns 0, or errno. */
static int try_lock(OutputLock *lock, const char *path)
{
    struct flock whole = {.l_whence = SEEK_SET};
    lock->file = open_file(path, &whole.l_type);
    if (lock->file < 0)
        return errno;
    if (fcntl(lock->file, F_OFD_SETLK, &whole) == 0)
        return 0;
    const int reason = errno;
    close(lock->file);
    return reason;
}

bool output_lock(OutputLock *lock, const char *path, Error *error)
{
    for (;;) {
        const int reason = try_lock(lock, path);
        lock->state = reason == 0 ? OUTPUT_LOCKED : reason == ENOENT ? OUTPUT_UNLOCKED : OUTPUT_UNGUARDED;
        if (lock->state == OUTPUT_LOCKED && !is_at(lock->file, path)) {
            output_unlock(lock); /* replaced in this moment */
            continue;
        }
        if (reason == EAGAIN || reason == EACCES) {
            lock->state = OUTPUT_UNLOCKED;
            return error_set(
                error, "%s: is being written by another slosh; wait for its end, or name another file", path);
        }
        if (lock->state == OUTPUT_UNGUARDED)
            tell_unguarded(path, reason);
        return true;
    }
}

void output_unlock(OutputLock *lock)
{
    if (lock->state == OUTPUT_LOCKED)
        close(lock->file);
    lock->state = OUTPUT_UNLOCKED;
}

bool output_lock_commit(OutputLock *older, Output *output, Error *error)
{
    bool there = true;
    while (there) {
        if (older->state == OUTPUT_UNGUARDED ||
            (older->state == OUTPUT_LOCKED && is_at(older->file, output->target))) {
            const bool named = output_commit(output, error);
            output_unlock(older);
            return named;
        }
        output_unlock(older);
        if (output_commit_new(output, &there, error))
            return true;
        if (there && !output_lock(older, output->path, error)) {
            output_discard(output);
            return false;
        }
    }
    return false;
}
