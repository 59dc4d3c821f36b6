/* The scene of a command line as a world on all ranks. Zero-initialise it. All functions are collective but
   stand_say. */
#ifndef SLOSH_STAND_H
#define SLOSH_STAND_H

#include "app/session/args.h"
#include "app/session/session.h"

typedef struct Stand {
    Session session; /* as of slosh run on each rank: its scene has the backend that the file names */
    int rank, size;
} Stand;

/* Rank and size; Ctrl-C is polled from now on. */
void stand_begin(Stand *stand);

/* 0, or the exit code and what is wrong. */
int stand_open(Stand *stand, const Args *args, const char *command, Error *error);

/* A step, and what the sentinel found in it; all steps of a frame. */
bool stand_substep(Stand *stand, Error *error);
bool stand_frame(Stand *stand, Error *error);

/* Whether any rank was told to stop. */
bool stand_interrupted(void);

/* On standard error, of the first rank alone. */
void stand_say(const Stand *stand, const char *words);

/* Ranks on this rank's machine, and the processors that they may use. */
void stand_machine(int *ranks, int *processors);

#endif
