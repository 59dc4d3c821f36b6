/* A recorded file on its way to the pictures: a thread reads its steps ahead of who shows them, keeps a few,
   and writes the one that is wanted into an Upload. Shown is the newest step at or before the time that is
   asked for (ReelSetup.at_or_after: the first one at or after it): nothing is interpolated.

   All functions here belong to one other thread, that of the GL context. */
#ifndef SLOSH_REEL_H
#define SLOSH_REEL_H

#include "app/playback/recorded.h"
#include "render/particles/upload.h"

enum { REEL_KEPT_LEAST = 3, REEL_KEPT_MOST = 32 };

typedef struct Reel Reel;

typedef struct ReelSetup {
    Recorded *recorded;  /* taken over, and emptied, where the reel could be made */
    unsigned attributes; /* PARTICLE_* that pictures read; what the file lacks of them is left out */
    size_t
        bytes; /* of memory for steps that were read: as many as fit, of REEL_KEPT_LEAST to REEL_KEPT_MOST */
    bool at_or_after;   /* shown is the first step at or after the time, or the last one */
    void (*wake)(void); /* called on the reel's thread when there is something new; may be NULL */
} ReelSetup;

/* Starts the thread; nothing is shown yet. NULL when memory is short. */
Reel *reel_create(const ReelSetup *setup, Error *error);
void reel_destroy(Reel *reel); /* NULL is allowed; waits for the step in hand */

/* The step for `time` (s) is wanted. `lead`: the next one will be asked for so many seconds further, less
   than 0 before; with it steps are read ahead; 0: nobody knows. */
void reel_seek(Reel *reel, double time, double lead);

/* What stands there now. */
typedef struct ReelStatus {
    size_t steps;       /* of the file as far as it is known */
    double first, last; /* times of the first and the last of them, s */
    bool answered;      /* the last reel_seek is: `index` is shown, or it failed */
    bool failed;        /* `message` says why; what was shown before stays */
    char message[1024];
    size_t index;         /* of the step that is shown */
    double time;          /* its time, s; of a step that failed that one's, */
    double before, after; /* and those of its neighbours: at the file's ends `time` itself */
    size_t particles;     /* of the step that is shown */
    uint64_t step;        /* its number in the run */
    bool replaced;        /* another file has the name now; this one is shown on */
    size_t read, found;   /* steps that were read; that were wanted and had been read */
    size_t kept;          /* steps that are kept at most */
} ReelStatus;

/* Call it before reel_take: a step with more particles than any before gets more room on the GPU here. False
   when there is none. */
bool reel_status(Reel *reel, ReelStatus *status, Error *error);

/* Waits until the last reel_seek is answered. */
bool reel_wait(Reel *reel, ReelStatus *status, Error *error);

/* As of upload_fresh and upload_take. */
bool reel_fresh(Reel *reel);
bool reel_take(Reel *reel, ParticleBuffers *out);

/* A line for each kind of flaw that was found in what was read. */
void reel_print_flaws(Reel *reel, FILE *file);

#endif
