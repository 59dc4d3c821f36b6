/* The scene of a command line as a world on all ranks. Zero-initialise it. All functions are collective but
   stand_say. */
#ifndef SLOSH_STAND_H
#define SLOSH_STAND_H

#include "app/scene/scene.h"
#include "app/session/args.h"
#include "app/session/session.h"

typedef struct Stand {
    Scene scene;  /* with the backend that its file names */
    World *world; /* the caller destroys it */
    WorldInfo info;
    int rank, size;
    TroubleTold told;
} Stand;

/* Rank and size; Ctrl-C is polled from now on. */
void stand_begin(Stand *stand);

/* 0, or the exit code and what is wrong. */
int stand_open(Stand *stand, const Args *args, const char *command, Error *error);

/* All steps of a frame, and what the sentinel found in them. */
bool stand_frame(Stand *stand, Error *error);

/* Whether any rank was told to stop. */
bool stand_interrupted(void);

/* On standard error, of the first rank alone. */
void stand_say(const Stand *stand, const char *words);

/* Ranks on this rank's machine, and the processors that they may use. */
void stand_machine(int *ranks, int *processors);

#endif
