/* A second thread that ends the window where the window itself cannot: the display is gone and a driver waits
   for it for ever, or a signal asks for the end while something lasts. The session is saved. */
#ifndef SLOSH_PLAY_GUARD_H
#define SLOSH_PLAY_GUARD_H

#include "app/session/simulator.h"

typedef struct Guard Guard;

/* `record`: where the session goes (may be NULL); `connection`: the display's file descriptor, or -1. Begins
   to watch; NULL where it cannot. */
Guard *guard_create(const char *record, int connection);

/* Whose session it is; NULL: none, from the return on. A guard of NULL is allowed. */
void guard_watch(Guard *guard, Simulator *simulator);

/* The window has seen it and ends by itself, or it has ended; frees nothing where the end is on its way. */
void guard_destroy(Guard *guard);

/* Where the session goes at such an end: `record`; or, when it has what is not saved, a file of its own, but
   after a Ctrl-C. False: nowhere. */
bool guard_path(const char *record, bool unsaved, char path[1024]);

#endif
