#define _GNU_SOURCE /* getdents64 */
#include "app/base/file.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LINKS_MAX = 40 };

static bool fits(int length)
{
    if (length < PATH_MAX)
        return true;
    errno = ENAMETOOLONG;
    return false;
}

/* Moves the last part of `path` to the front of `rest`. */
static bool take_last(char path[PATH_MAX], char rest[PATH_MAX])
{
    char joined[PATH_MAX];
    char *slash = strrchr(path, '/');
    if (!fits(snprintf(joined, sizeof joined, "/%s%s", slash ? slash + 1 : path, rest)))
        return false;
    snprintf(rest, PATH_MAX, "%s", joined);
    if (!slash)
        snprintf(path, PATH_MAX, ".");
    else
        slash[slash == path] = '\0';
    return true;
}

/* Replaces `path`, a link, by the link's target. */
static bool follow(char path[PATH_MAX], const char *says)
{
    char followed[PATH_MAX];
    const char *slash = strrchr(path, '/');
    const int folder = slash && *says != '/' ? (int)(slash - path) + 1 : 0;
    if (!fits(snprintf(followed, sizeof followed, "%.*s%s", folder, path, says)))
        return false;
    snprintf(path, PATH_MAX, "%s", followed);
    return true;
}

static void strip_slashes(char *path)
{
    for (size_t length = strlen(path); length > 1 && path[length - 1] == '/'; length--)
        path[length - 1] = '\0';
}

bool path_resolve(const char *path, char place[PATH_MAX])
{
    char head[PATH_MAX], rest[PATH_MAX] = "", says[PATH_MAX];
    int links = 0;
    if (!fits(snprintf(head, sizeof head, "%s", path)))
        return false;
    strip_slashes(head);
    while (!realpath(head, place)) {
        if (errno != ENOENT || !*head)
            return false;
        const ssize_t length = readlink(head, says, sizeof says - 1);
        if (length > 0 && ++links > LINKS_MAX) {
            errno = ELOOP;
            return false;
        }
        says[length > 0 ? length : 0] = '\0';
        if (!(length > 0 ? follow(head, says) : take_last(head, rest)))
            return false;
        strip_slashes(head);
    }
    const size_t used = strcmp(place, "/") == 0 ? 0 : strlen(place);
    return fits(snprintf(place + used, PATH_MAX - used, "%s", *rest || used ? rest : "/") + (int)used);
}

enum { PENDING_MAX = 8 };

static pthread_mutex_t adding = PTHREAD_MUTEX_INITIALIZER; /* the window and the solver's thread save */

/* The only state reachable by a signal handler, and by a thread that ends the program. */
static struct {
    atomic_int used; /* lock-free; set after the other members */
    pid_t owner;     /* a child that crashes leaves the files of its parent */
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

void output_pending_remove(const char *temp)
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

/* Removes files left by killed writers: only the next writer of the same output knows that such files are
   useless. */

/* True for NAME.PID.tmp if no process has that id. */
static bool is_stale(const char *entry, const char *name)
{
    const size_t length = strlen(name);
    char *end;
    if (strncmp(entry, name, length) != 0 || entry[length] != '.' ||
        !isdigit((unsigned char)entry[length + 1]))
        return false;
    const long pid = strtol(entry + length + 1, &end, 10);
    return strcmp(end, ".tmp") == 0 && pid > 0 && kill((pid_t)pid, 0) != 0 && errno == ESRCH;
}

static void clear(const char *path)
{
    struct stat status;
    if (lstat(path, &status) == 0 && S_ISDIR(status.st_mode))
        output_remove_folder(path);
    else
        unlink(path);
}

/* Removes temporary files of the same output left by writers that no longer run. Each begin of an output
   calls this function. */
static void output_clear_stale(const char *target)
{
    const char *slash = strrchr(target, '/'), *name = slash ? slash + 1 : target;
    char folder[1024] = ".", path[2048];
    if (slash)
        snprintf(folder, sizeof folder, "%.*s", slash == target ? 1 : (int)(slash - target), target);
    DIR *entries = opendir(folder);
    for (const struct dirent *entry; entries && (entry = readdir(entries));)
        if (is_stale(entry->d_name, name)) {
            snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
            clear(path);
        }
    if (entries)
        closedir(entries);
}

/* Forgets the temporary file after its renaming or removal. */
static void forget(Output *output)
{
    output_pending_remove(output->temp);
    output->temp[0] = '\0';
}

/* The folder of `path`, for messages. */
static void folder_of(const char *path, char folder[1024])
{
    const char *slash = strrchr(path, '/');
    if (!slash)
        snprintf(folder, 1024, ".");
    else
        snprintf(folder, 1024, "%.*s", slash == path ? 1 : (int)(slash - path), path);
}

static bool refuse(const char *path, const char *target, int reason, Error *error)
{
    char folder[1024];
    struct stat status;
    folder_of(target, folder);
    if (stat(folder, &status) != 0)
        return error_set(error, "%s: cannot be written: the folder %s: %s; create it first", path, folder,
                         strerror(errno));
    if (!S_ISDIR(status.st_mode))
        return error_set(error, "%s: cannot be written: %s is not a folder", path, folder);
    return error_set(error, "%s: cannot be written in the folder %s: %s; choose another folder", path, folder,
                     strerror(reason));
}

static bool path_is_file_or_free(const char *path, Error *error)
{
    struct stat status;
    size_t length = strlen(path);
    if (length == 0)
        return error_set(error, "the name of the output is empty; name a file");
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode))
        return error_set(error, "%s: %s; name a file", path,
                         S_ISDIR(status.st_mode) ? "is a folder" : "is not a plain file");
    if (path[length - 1] == '/')
        return error_set(error, "%s: ends in a slash; name a file", path);
    return true;
}

/* Resolves `path` if it is a link; also for folders (output_folder). Returns false with the reason, for
   example a too long path. */
static bool output_target(const char *path, char target[1024], Error *error)
{
    char place[PATH_MAX];
    struct stat status;
    if (strlen(path) >= 1024)
        return error_set(error, "the name of the output has more than %d bytes; name a shorter one", 1023);
    const bool link = lstat(path, &status) == 0 && S_ISLNK(status.st_mode);
    if (link && !path_resolve(path, place))
        return error_set(error, "%s: is a link that leads nowhere: %s; name a file", path, strerror(errno));
    if (snprintf(target, 1024, "%s", link ? place : path) < 1024)
        return true;
    return error_set(error, "%s: is a link to a name of more than %d bytes; name a file", path, 1023);
}

bool output_begin(Output *output, const char *path, Error *error)
{
    output->temp[0] = '\0';
    if (!path_is_file_or_free(path, error))
        return false;
    if (!output_target(path, output->target, error))
        return false;
    snprintf(output->path, sizeof output->path, "%s", path);
    output_clear_stale(output->target);
    const char *here = output->target[0] == '/' ? "" : "./"; /* so that no program takes the name
                                                                for an option, a protocol or a pipe */
    snprintf(output->temp, sizeof output->temp, "%s%s.%ld.tmp", here, output->target, (long)getpid());
    int file = open(output->temp, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0) {
        int reason = errno;
        output->temp[0] = '\0';
        return refuse(path, output->target, reason, error);
    }
    close(file);
    output_pending_add(output->temp);
    return true;
}

static bool named(Output *output, bool renamed, Error *error)
{
    if (!renamed) {
        error_set(error, "%s: cannot be given its name: %s", output->path, strerror(errno));
        output_discard(output);
        return false;
    }
    forget(output);
    return true;
}

bool output_commit(Output *output, Error *error)
{
    return named(output, rename(output->temp, output->target) == 0, error);
}

/* Without support in the file system, a file created in this moment is replaced. */
bool output_commit_new(Output *output, bool *there, Error *error)
{
    bool renamed = renameat2(AT_FDCWD, output->temp, AT_FDCWD, output->target, RENAME_NOREPLACE) == 0;
    *there = !renamed && errno == EEXIST;
    if (*there)
        return false;
    if (!renamed && (errno == EINVAL || errno == ENOSYS))
        renamed = rename(output->temp, output->target) == 0;
    return named(output, renamed, error);
}

void output_discard(Output *output)
{
    if (output->temp[0] == '\0')
        return;
    unlink(output->temp);
    forget(output);
}

bool output_print(const char *path, bool (*print)(const void *of, FILE *file), const void *of, Error *error)
{
    Output output = {.path = ""};
    if (!output_begin(&output, path, error))
        return false;
    FILE *file = fopen(output.temp, "w");
    if (file) {
        const bool whole = print(of, file) && !ferror(file);
        if (fclose(file) == 0 && whole)
            return output_commit(&output, error);
    }
    error_set(error, "%s: cannot be written (%s)", path, strerror(errno));
    output_discard(&output);
    return false;
}

bool output_check(const char *path, Error *error)
{
    Output output = {0};
    if (!output_begin(&output, path, error))
        return false;
    output_discard(&output);
    return true;
}

/* Skips the name of a part, "-fluid0"; returns `at` if there is none. */
static const char *skip_part(const char *at)
{
    if (*at != '-')
        return at;
    const size_t letters = strspn(at + 1, "abcdefghijklmnopqrstuvwxyz");
    const size_t digits = strspn(at + 1 + letters, "0123456789");
    return letters > 0 && digits > 0 ? at + 1 + letters + digits : at;
}

/* True for NAME-DIGITS, an optional part's name, and the suffix. */
static bool is_ours(const OutputFolder *folder, const char *file)
{
    const char *slash = strrchr(folder->path, '/');
    const char *name = slash ? slash + 1 : folder->path;
    const size_t length = strlen(name);
    if (strncmp(file, name, length) != 0 || file[length] != '-')
        return false;
    const char *number = file + length + 1;
    const size_t digits = strspn(number, "0123456789");
    return digits > 0 && strcmp(skip_part(number + digits), folder->suffix) == 0;
}

/* Checks that an older folder of that name has only files of exports: replacing must lose no other files. */
static bool check_older(const OutputFolder *folder, Error *error)
{
    const struct dirent *entry;
    bool ours = true;
    DIR *older = opendir(folder->path);
    if (!older)
        return errno == ENOENT || error_set(error, "%s: is to be a folder, which cannot be read: %s",
                                            folder->path, strerror(errno));
    while (ours && (entry = readdir(older)))
        ours = strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0 ||
               is_ours(folder, entry->d_name) ||
               error_set(error,
                         "%s: this folder would be replaced, but '%.200s' in it is no %s of an export; name "
                         "another output",
                         folder->path, entry->d_name, folder->suffix);
    closedir(older);
    return ours;
}

bool output_folder_begin(OutputFolder *folder, const char *path, const char *suffix, Error *error)
{
    *folder = (OutputFolder){.suffix = suffix};
    if (!output_target(path, folder->target, error))
        return false;
    snprintf(folder->path, sizeof folder->path, "%s", path);
    if (!check_older(folder, error))
        return false;
    output_clear_stale(folder->target);
    snprintf(folder->temp, sizeof folder->temp, "%s.%ld.tmp", folder->target, (long)getpid());
    output_remove_folder(folder->temp); /* left by a killed program with the same process id */
    if (mkdir(folder->temp, 0777) != 0) {
        folder->temp[0] = '\0';
        return error_set(error, "%s: the folder cannot be created: %s", path, strerror(errno));
    }
    output_pending_add(folder->temp);
    return true;
}

/* Exchanges old and new folder at once, or, without support in the file system, one after the other. */
static bool replace_older(const OutputFolder *folder)
{
    char aside[sizeof folder->temp + 4];
    if (renameat2(AT_FDCWD, folder->temp, AT_FDCWD, folder->target, RENAME_EXCHANGE) == 0) {
        output_remove_folder(folder->temp);
        return true;
    }
    snprintf(aside, sizeof aside, "%s.old", folder->temp);
    if ((errno != EINVAL && errno != ENOSYS) || rename(folder->target, aside) != 0)
        return false;
    if (rename(folder->temp, folder->target) != 0) {
        rename(aside, folder->target);
        return false;
    }
    output_remove_folder(aside);
    return true;
}

bool output_folder_commit(OutputFolder *folder, Error *error)
{
    bool named = check_older(folder, error);
    if (named && rename(folder->temp, folder->target) != 0) /* works if the target is missing or empty */
        named = ((errno == ENOTEMPTY || errno == EEXIST) && replace_older(folder)) ||
                error_set(error, "%s: cannot be given its name: %s", folder->path, strerror(errno));
    if (!named) {
        output_folder_discard(folder);
        return false;
    }
    output_pending_remove(folder->temp);
    folder->temp[0] = '\0';
    return true;
}

void output_folder_discard(OutputFolder *folder)
{
    if (folder->temp[0] == '\0')
        return;
    output_remove_folder(folder->temp);
    output_pending_remove(folder->temp);
    folder->temp[0] = '\0';
}

static void tell_unguarded(const char *path, int reason)
{
    static bool reported;
    if (!reported)
        fprintf(
            stderr,
            "%s: cannot be locked here (%s): another slosh that writes the same file will not be noticed\n",
            path, strerror(reason));
    reported = true;
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
        lock->state = reason == 0 ? OUTPUT_LOCKED : reason == ENOENT ? OUTPUT_UNLOCKED : OUTPUT_UNLOCKABLE;
        if (lock->state == OUTPUT_LOCKED && !is_at(lock->file, path)) {
            output_unlock(lock); /* replaced in this moment */
            continue;
        }
        if (reason == EAGAIN || reason == EACCES) {
            lock->state = OUTPUT_UNLOCKED;
            return error_set(
                error, "%s: is being written by another slosh; wait for its end, or name another file", path);
        }
        if (lock->state == OUTPUT_UNLOCKABLE)
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
        if (older->state == OUTPUT_UNLOCKABLE ||
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
