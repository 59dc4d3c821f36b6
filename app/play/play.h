/* The live window: a scene simulated on a thread of its own, drawn, and moved by hand. */
#ifndef SLOSH_PLAY_H
#define SLOSH_PLAY_H

#include "app/device/mapping.h"
#include "app/meter/report.h"
#include "app/session/args.h"

typedef struct PlaySetup {
    const char *scene;
    const SceneSettings *settings; /* of that scene; others open as their files have them */
    int width, height;             /* of the window, in screen coordinates */
    const char *record;            /* the session is written there at the end; or NULL */
    size_t past_bytes;             /* memory for states to step back to; 0: none */
    const Mapping *mapping;        /* of motion devices; NULL: they are left alone */
    const char *device;            /* --device, or NULL: what is plugged in */
    double shake_seconds;          /* more than 0: the box is shaken by a script for so long, then all ends */
    const char *json; /* SIGUSR1 writes the figures so far there; NULL: to standard error, for people */
    bool quiet;
} PlaySetup;

/* Runs until the user, a signal or the script ends it. Returns the exit code; on failure the message has been
   printed. */
int play(const PlaySetup *setup, PlayFigures *figures);

#endif
