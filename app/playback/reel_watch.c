#include "app/playback/reel_watch.h"

#include <math.h>
#include <stdio.h>

/* Shows the seer the requested step, unless seen before. */
static bool watch_step(ReelWatch *watch, Reel *reel, double least, const ReelSeer *seer, ReelStatus *status,
                       Error *error)
{
    ParticleBuffers particles;
    if (!reel_wait(reel, status, error)) {
        if (status->failed && !watch->skipped)
            fprintf(stderr, "%s; overlays do without it\n", status->message);
        watch->skipped |= status->failed;
        return status->failed;
    }
    if (status->time < fmax(least, watch->watched + 0.999 * watch->every) || status->time <= watch->watched ||
        !reel_take(reel, &particles))
        return true;
    seer->see(seer->user, &particles);
    watch->watched = status->time;
    return true;
}

bool reel_watch(ReelWatch *watch, Reel *reel, double time, const ReelSeer *seer, ReelStatus *status,
                Error *error)
{
    const double least = time - watch->before - 1e-9 * fmax(fabs(time), 1);
    double at = fmax(least, watch->watched), lead = 0;
    while (at < time && !isinf(watch->every)) {
        reel_seek(reel, at, lead);
        if (!watch_step(watch, reel, least, seer, status, error))
            return false;
        if (status->after <= status->time)
            break; /* the file's last step */
        lead = status->after - status->time;
        const double next = fmax(status->after, watch->watched + 0.999 * watch->every);
        if (!(next > at))
            break; /* the step's time cannot be read */
        at = next;
    }
    return true;
}
