#include "app/watch/watch.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const double LOOK_MS = 50, REST_MS = 120, GRACE_MS = 2000;

static WatchMark mark_of(const char *path)
{
    struct stat is;
    if (stat(path, &is) != 0)
        return (WatchMark){.there = false};
    return (WatchMark){is.st_mtim.tv_sec, is.st_mtim.tv_nsec, is.st_size, is.st_ino, true};
}

static bool same(const WatchMark *a, const WatchMark *b)
{
    return a->there == b->there && a->seconds == b->seconds && a->nanoseconds == b->nanoseconds &&
           a->size == b->size && a->inode == b->inode;
}

bool watch_add(Watch *watch, const char *path)
{
    for (int i = 0; i < watch->count; i++)
        if (strcmp(watch->files[i].path, path) == 0)
            return true;
    if (watch->count == WATCH_FILES_MAX || strlen(path) >= WATCH_PATH_SIZE)
        return false;
    snprintf(watch->files[watch->count].path, WATCH_PATH_SIZE, "%s", path);
    watch->files[watch->count].mark = mark_of(path);
    watch->count++;
    return true;
}

void watch_keep(Watch *watch, const Watch *before)
{
    for (int i = 0; i < watch->count; i++)
        for (int k = 0; k < before->count; k++)
            if (strcmp(watch->files[i].path, before->files[k].path) == 0)
                watch->files[i].mark = before->files[k].mark;
}

bool watch_look(Watch *watch, double now_ms)
{
    if (watch->count == 0 || now_ms < watch->looked_ms + LOOK_MS)
        return false;
    watch->looked_ms = now_ms;
    for (int i = 0; i < watch->count; i++) {
        const WatchMark now = mark_of(watch->files[i].path);
        if (same(&now, &watch->files[i].mark))
            continue;
        watch->files[i].mark = now;
        watch->others = (watch->pending && watch->others) || i > 0;
        watch->pending = true;
        watch->changed_ms = now_ms;
    }
    const WatchMark *first = &watch->files[0].mark;
    const double wait = first->there && first->size > 0 ? REST_MS : GRACE_MS;
    if (!watch->pending || now_ms < watch->changed_ms + wait)
        return false;
    watch->pending = false;
    return true;
}
