/* A second thread that ends the program if the window cannot: when the display is gone and a driver waits
   forever, or when a signal comes during a long operation. Saves the session. */
#ifndef SLOSH_PLAY_GUARD_H
#define SLOSH_PLAY_GUARD_H

#include "app/run/simulator.h"

typedef struct Guard Guard;

/* Starts the guard. `record`: file for the session (may be NULL); `connection`: the display's file
   descriptor, or -1. Returns NULL on failure. */
Guard *guard_create(const char *record, int connection);

/* Sets the simulator to save; NULL: none, effective on return. A NULL guard is allowed. */
void guard_watch(Guard *guard, Simulator *simulator);

/* Stops the guard, if the window ends by itself; if the guard is already ending the program, never
   returns. */
void guard_destroy(Guard *guard);

/* File for the session at such an end: `record`; otherwise, with unsaved changes, a new file, except after
   Ctrl-C. Returns false if the session is not saved. */
bool guard_path(const char *record, bool unsaved, char path[1024]);

#endif
