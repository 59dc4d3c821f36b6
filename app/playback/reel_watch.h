/* Steps of a file between two pictures, for overlays that follow particles (OverlayKind.every). */
#ifndef SLOSH_REEL_WATCH_H
#define SLOSH_REEL_WATCH_H

#include "app/playback/reel.h"

/* Who sees a step. */
typedef struct ReelSeer {
    void (*see)(void *user, const ParticleBuffers *particles);
    void *user;
} ReelSeer;

/* Of a reel. */
typedef struct ReelWatch {
    double every,
        before;     /* s: overlays see states so far apart, for so long before a picture; INFINITY: none */
    double watched; /* time of the last step that they saw, s; at first -INFINITY */
    bool skipped;   /* a step could not be read; told */
} ReelWatch;

/* Shows the seer the steps before the picture at `time` (s); `status` is then of the last of them. False on
   failure, but for steps that cannot be read: these are told of on the terminal, once. */
bool reel_watch(ReelWatch *watch, Reel *reel, double time, const ReelSeer *seer, ReelStatus *status,
                Error *error);

#endif
