/* The live window: simulates a scene on a separate thread, draws the scene, and moves the box by hand. */
#ifndef SLOSH_PLAY_H
#define SLOSH_PLAY_H

#include "app/input/mapping.h"
#include "app/meter/report.h"
#include "app/session/args.h"

typedef struct PlaySetup {
    const char *scene;
    const SceneSettings *settings; /* of that scene; scenes opened later use their files */
    int width, height;             /* of the window, in screen coordinates */
    const char *record;            /* file for the session at the end; or NULL */
    size_t history_bytes;          /* memory for states to go back to; 0: none */
    const Mapping *mapping;        /* of motion devices; NULL: devices are not used */
    const char *device;            /* --device, or NULL: the plugged in devices */
    double shake_seconds;          /* more than 0: a script shakes the box for that time, then all ends */
    const char *json;              /* file for the figures on SIGUSR1; NULL: standard error, for people */
    bool quiet;
} PlaySetup;

/* Runs until the user, a signal or the script ends the window. Returns the exit code; errors have been
   printed. */
int play(const PlaySetup *setup, PlayFigures *figures);

#endif
