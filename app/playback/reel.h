/* Prepares a recorded file's steps for pictures: a thread reads steps ahead, keeps a few, and writes the
   requested step into an Upload. The shown step is the newest at or before the requested time
   (ReelSetup.at_or_after: the first at or after the time), without interpolation.

   All functions here belong to one other thread, the thread of the GL context. */
#ifndef SLOSH_REEL_H
#define SLOSH_REEL_H

#include "app/playback/recorded.h"
#include "render/particles/upload.h"

enum { REEL_KEPT_LEAST = 3, REEL_KEPT_MOST = 32 };

typedef struct Reel Reel;

typedef struct ReelSetup {
    Recorded *recorded;  /* taken over and emptied if the reel could be made */
    unsigned attributes; /* PARTICLE_* read by pictures; attributes missing in the file are left out */
    size_t bytes;       /* memory for read steps: as many as fit, within REEL_KEPT_LEAST and REEL_KEPT_MOST */
    bool at_or_after;   /* show the first step at or after the time, or the last step */
    void (*wake)(void); /* called on the reel's thread on any news; may be NULL */
} ReelSetup;

/* Starts the thread; nothing is shown yet. Returns NULL if memory is short. */
Reel *reel_create(const ReelSetup *setup, Error *error);
void reel_destroy(Reel *reel); /* NULL is allowed; waits for the step being read */

/* Requests the step for `time` (s). `lead`: expected advance to the next request, s, negative for
   backwards; steps are read ahead accordingly. 0: unknown. */
void reel_seek(Reel *reel, double time, double lead);

/* Present state of a reel. */
typedef struct ReelStatus {
    size_t steps;       /* known steps of the file */
    double first, last; /* times of the first and the last step, s */
    bool answered;      /* the last reel_seek is finished: `index` is shown, or it failed */
    bool failed;        /* `message` has the reason; the earlier step stays shown */
    char message[1024];
    size_t index;         /* of the shown step */
    double time;          /* time of the shown step, s; after a failure, of the failed step */
    double before, after; /* times of its neighbours; at the file's ends `time` itself */
    size_t particles;     /* of the shown step */
    uint64_t step;        /* the shown step's number in the run */
    bool replaced;        /* another file has the name now; the opened file is still shown */
    size_t read, found;   /* steps read; steps already in memory when requested */
    size_t kept;          /* greatest count of kept steps */
} ReelStatus;

/* Call before reel_take: allocates more GPU memory for a step with more particles than before. Returns
   false if memory is short. */
bool reel_status(Reel *reel, ReelStatus *status, Error *error);

/* Waits until the last reel_seek is finished. */
bool reel_wait(Reel *reel, ReelStatus *status, Error *error);

/* See upload_fresh and upload_take. */
bool reel_fresh(Reel *reel);
bool reel_take(Reel *reel, ParticleBuffers *out);

/* Prints a line for each kind of flaw in the steps read so far. */
void reel_print_flaws(Reel *reel, FILE *file);

#endif
