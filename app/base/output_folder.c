#define _GNU_SOURCE /* renameat2 */
#include "app/base/output_folder.h"

#include "app/base/output.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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
    output_pending_forget(folder->temp);
    folder->temp[0] = '\0';
    return true;
}

void output_folder_discard(OutputFolder *folder)
{
    if (folder->temp[0] == '\0')
        return;
    output_remove_folder(folder->temp);
    output_pending_forget(folder->temp);
    folder->temp[0] = '\0';
}
