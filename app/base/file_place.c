#include "app/base/file_place.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
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

bool file_place(const char *path, char place[PATH_MAX])
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
