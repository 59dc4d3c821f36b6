/* Polls files for changes by an editor. Compares time, size and inode number, so that renaming a new file
   over the old one counts too. */
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

/* Zero-initialise before use. */
typedef struct Watch {
    int count;
    struct {
        char path[WATCH_PATH_SIZE];
        WatchMark mark;
    } files[WATCH_FILES_MAX];
    double looked_ms, changed_ms; /* wall time */
    bool pending;                 /* changing now, or a moment ago */
    bool others;                  /* the pending or last reported change includes more than the first file */
} Watch;

/* Adds a file in its present state, unless already present; returns false if the list is full or the path too
   long. The first file is the main file, the rest belong to the main file. */
bool watch_add(Watch *watch, const char *path);

/* Takes over the state of files that `before` also watches: writes since then count as changes. */
void watch_keep(Watch *watch, const Watch *before);

/* Call once per picture or more often with the wall time: returns true once after a change, when the files
   have been stable for a moment. Waits up to two seconds for a missing or empty first file. */
bool watch_look(Watch *watch, double now_ms);

#endif
