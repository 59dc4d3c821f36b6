/* The scene of a command line as a world on all ranks. Zero-initialise before use. All functions except
   stand_say are collective. */
#ifndef SLOSH_STAND_H
#define SLOSH_STAND_H

#include "app/run/session.h"
#include "app/session/args.h"

typedef struct Stand {
    Session session; /* like slosh run's on each rank; the scene has the backend named in the file */
    int rank, size;
} Stand;

/* Finds rank and size; from now on Ctrl-C is polled. */
void stand_begin(Stand *stand);

/* Opens the scene. Returns 0, or the exit code with the reason. */
int stand_open(Stand *stand, const Args *args, const char *command, Error *error);

/* Make one step, with the sentinel's check; all steps of a frame. */
bool stand_substep(Stand *stand, Error *error);
bool stand_frame(Stand *stand, Error *error);

/* Returns true if any rank got a stop signal. */
bool stand_interrupted(void);

/* Prints on standard error, on the first rank only. */
void stand_say(const Stand *stand, const char *words);

/* Counts the ranks on this rank's machine, and their usable processors. */
void stand_machine(int *ranks, int *processors);

#endif
