/* Removes files left by killed writers: only the next writer of the same output knows that such files are
   useless. */
#include "app/base/output.h"

#include "app/base/output_pending.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

void output_clear_stale(const char *target)
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
