/* Steps of a file between two pictures, for overlays following particles (OverlayKind.every). */
#ifndef SLOSH_REEL_WATCH_H
#define SLOSH_REEL_WATCH_H

#include "app/playback/reel.h"

/* A callback for steps. */
typedef struct ReelSeer {
    void (*see)(void *user, const ParticleBuffers *particles);
    void *user;
} ReelSeer;

/* State of watching a reel. */
typedef struct ReelWatch {
    double every, before; /* interval of states for overlays, and time before a picture, s; INFINITY: none */
    double watched;       /* time of the last step seen by overlays, s; initially -INFINITY */
    bool skipped;         /* a step could not be read; reported */
} ReelWatch;

/* Shows the seer the steps before the picture at `time` (s); `status` is of the last of these steps.
   Returns false on failure. Unreadable steps are only reported on the terminal, once. */
bool reel_watch(ReelWatch *watch, Reel *reel, double time, const ReelSeer *seer, ReelStatus *status,
                Error *error);

#endif
