#define _GNU_SOURCE /* renameat2 */
#include "app/base/output.h"

#include "app/base/file_place.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Forgets the temporary file after its renaming or removal. */
static void forget(Output *output)
{
    output_pending_forget(output->temp);
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

bool output_target(const char *path, char target[1024], Error *error)
{
    char place[PATH_MAX];
    struct stat status;
    if (strlen(path) >= 1024)
        return error_set(error, "the name of the output has more than %d bytes; name a shorter one", 1023);
    const bool link = lstat(path, &status) == 0 && S_ISLNK(status.st_mode);
    if (link && !file_place(path, place))
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

bool output_check(const char *path, Error *error)
{
    Output output = {0};
    if (!output_begin(&output, path, error))
        return false;
    output_discard(&output);
    return true;
}
