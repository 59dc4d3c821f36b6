/* Files that are looked at again and again: whether an editor has written one. By their time, size and
   number, so that one that is renamed over another counts too. */
#ifndef SLOSH_WATCH_H
#define SLOSH_WATCH_H

#include <stdbool.h>
#include <stdint.h>

enum { WATCH_FILES_MAX = 32, WATCH_PATH_SIZE = 1200 };

typedef struct WatchMark {
    int64_t seconds, nanoseconds, size;
    uint64_t inode;
    bool there;
} WatchMark;

/* Zero-initialise it. */
typedef struct Watch {
    int count;
    struct {
        char path[WATCH_PATH_SIZE];
        WatchMark mark;
    } files[WATCH_FILES_MAX];
    double looked_ms, changed_ms; /* wall time */
    bool pending;                 /* it changes still, or did just now */
    bool others;                  /* of what is pending or was told last: not the first file alone */
} Watch;

/* Adds a file as it is now, unless it is there; more than WATCH_FILES_MAX are left out, false. The first one
 * is what the others belong to. */
bool watch_add(Watch *watch, const char *path);

/* Files that `before` has too are as they were seen there: what was written in between counts. */
void watch_keep(Watch *watch, const Watch *before);

/* Once a picture or more often, with the wall time: true once after a change, when the files have been at
   rest for a moment. A first file that is missing or empty is waited for, up to two seconds. */
bool watch_look(Watch *watch, double now_ms);

#endif
