#include "app/playback/reel.h"

#include "app/files/snapshot_hdf5.h"
#include "sim/base/stage.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

static const double FOLLOW_MS = 500; /* interval of checks if the file has grown */

/* A step in memory. */
typedef struct Kept {
    bool is;
    size_t index;
    double before, after; /* times of the neighbour steps */
    Still still;
} Kept;

struct Reel {
    unsigned attributes;
    size_t bytes;
    bool at_or_after;
    void (*wake)(void);

    pthread_t thread;
    pthread_mutex_t mutex; /* guards all members down to the next blank line */
    pthread_cond_t wanted, done;
    double time, lead;
    unsigned asked, answered; /* counts of reel_seek */
    size_t room, needs;       /* particles: capacity of the upload; size of the requested step if larger */
    bool quit;
    ReelStatus status;
    SnapshotFlaws flaws; /* a copy */

    Upload *upload;    /* written by the thread; replaced while the thread waits for room */
    Upload *before;    /* the replaced upload, until the new upload has a state; or NULL */
    Recorded recorded; /* used by the thread only */
    struct stat file;  /* status of the file when opened */
    Kept kept[REEL_KEPT_MOST];
    size_t kept_most;
    size_t shown;       /* step index in the file; SIZE_MAX: none */
    double followed_ms; /* wall time of the last check if the file has grown */
};

/* ---- steps ---- */

static size_t step_bytes(const Still *still)
{
    size_t bytes = sizeof(float[4]) + sizeof(float[4]) + 2 * sizeof(uint32_t);
    for (size_t s = 0; s < sizeof still->arrays.scalar / sizeof *still->arrays.scalar; s++)
        bytes += still->arrays.scalar[s] ? sizeof(float) : 0;
    return bytes * (still->room + 1);
}

static size_t clamp(size_t value, size_t least, size_t most)
{
    return value < least ? least : value > most ? most : value;
}

static Kept *find_kept(Reel *reel, size_t index)
{
    for (size_t k = 0; k < REEL_KEPT_MOST; k++)
        if (reel->kept[k].is && reel->kept[k].index == index)
            return &reel->kept[k];
    return NULL;
}

/* Rank of a kept step for removal: steps behind, seen along `lead`, before steps ahead; far steps before
   near steps. */
static double uselessness(const Kept *kept, size_t index, double lead)
{
    const double ahead = (lead < 0 ? -1 : 1) * ((double)kept->index - (double)index);
    return ahead < 0 ? 1e18 - ahead : ahead;
}

/* Returns a place for one more step: free, or with the least useful step for a reader at `index`. */
static Kept *place_for(Reel *reel, size_t index, double lead)
{
    Kept *worst = &reel->kept[0];
    for (size_t k = 0; k < reel->kept_most; k++) {
        Kept *kept = &reel->kept[k];
        if (!kept->is)
            return kept;
        if (uselessness(kept, index, lead) > uselessness(worst, index, lead))
            worst = kept;
    }
    return worst;
}

static bool read_neighbours(Reel *reel, Kept *kept, Error *error)
{
    Recorded *recorded = &reel->recorded;
    kept->before = kept->after = kept->still.state.time;
    return (kept->index == 0 || recorded_time(recorded, kept->index - 1, &kept->before, error)) &&
           (kept->index + 1 >= recorded->steps ||
            recorded_time(recorded, kept->index + 1, &kept->after, error));
}

/* Reduces the kept steps to as many as fit if all are as large as `kept`, which stays. */
static Kept *keep_fewer(Reel *reel, Kept *kept)
{
    const size_t most = clamp(reel->bytes / step_bytes(&kept->still), REEL_KEPT_LEAST, reel->kept_most);
    if (kept >= reel->kept + most) {
        const Kept other = reel->kept[0];
        reel->kept[0] = *kept;
        *kept = other;
        kept = &reel->kept[0];
    }
    for (size_t k = most; k < reel->kept_most; k++) {
        still_free(&reel->kept[k].still);
        reel->kept[k].is = false;
    }
    reel->kept_most = most;
    return kept;
}

static Kept *read_into(Reel *reel, Kept *kept, size_t index, Error *error)
{
    kept->is = recorded_read(&reel->recorded, index, reel->attributes, &kept->still, error);
    kept->index = index;
    return kept->is ? keep_fewer(reel, kept) : NULL;
}

/* ---- the thread ---- */

/* Waits, for a limited time, until a step is requested. Call with the mutex locked. */
static void wait_for_work(Reel *reel)
{
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += (long)(1e6 * FOLLOW_MS);
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    while (!reel->quit && reel->asked == reel->answered &&
           pthread_cond_timedwait(&reel->wanted, &reel->mutex, &until) == 0)
        continue;
}

static void tell(Reel *reel)
{
    pthread_cond_broadcast(&reel->done);
    if (reel->wake)
        reel->wake();
}

/* Writes a step into the upload, after waiting for room. Returns false to end the thread. */
static bool show(Reel *reel, const Kept *kept, Error *error)
{
    const size_t count = kept->still.state.count;
    pthread_mutex_lock(&reel->mutex);
    while (count > reel->room && !reel->quit) {
        reel->needs = count;
        tell(reel);
        pthread_cond_wait(&reel->wanted, &reel->mutex);
    }
    const bool goes_on = !reel->quit;
    pthread_mutex_unlock(&reel->mutex);
    if (!goes_on || reel->shown == kept->index)
        return goes_on;
    reel->shown = kept->index;
    return upload_arrays(reel->upload, &kept->still.arrays, &kept->still.state, error);
}

/* Updates the status, with the mutex locked: the requested place in the file, even if the step cannot be
   shown. */
static void describe(Reel *reel, const Kept *kept)
{
    ReelStatus *status = &reel->status;
    status->time = kept->still.state.time;
    status->before = kept->before;
    status->after = kept->after;
    status->kept = reel->kept_most;
}

static void describe_file(Reel *reel)
{
    reel->status.steps = reel->recorded.steps;
    reel->status.first = reel->recorded.first;
    reel->status.last = reel->recorded.last;
    reel->flaws = reel->recorded.flaws;
}

static bool find(Reel *reel, double time, size_t *index, Error *error)
{
    return (reel->at_or_after ? recorded_find_after : recorded_find)(&reel->recorded, time, index, error);
}

/* Shows the last requested step; `place` gets its place in the file. Returns false with the reason, and
   `place` as far as known. */
static bool show_asked(Reel *reel, double time, double lead, Kept *place, bool *read, Error *error)
{
    if (!find(reel, time, &place->index, error))
        return false;
    Kept *kept = find_kept(reel, place->index);
    *read = !kept;
    if (!kept)
        kept = read_into(reel, place_for(reel, place->index, lead), place->index, error);
    Error none; /* the first reason counts */
    double *at = &place->still.state.time;
    place->is = recorded_time(&reel->recorded, place->index, at, kept ? error : &none) &&
                read_neighbours(reel, place, kept ? error : &none);
    return kept && place->is && show(reel, kept, error);
}

static void answer(Reel *reel, double time, double lead, unsigned asked)
{
    Error error = {{0}};
    Kept place = {.index = 0};
    bool read = false;
    const bool shown = show_asked(reel, time, lead, &place, &read, &error);
    pthread_mutex_lock(&reel->mutex);
    ReelStatus *status = &reel->status;
    reel->answered = asked;
    status->read += read;
    status->found += shown && !read;
    status->failed = !shown;
    status->index = shown ? place.index : status->index;
    if (shown) {
        const ParticleBuffers *state = &find_kept(reel, place.index)->still.state;
        status->particles = state->count;
        status->step = state->step;
    }
    snprintf(status->message, sizeof status->message, "%s", error.message);
    if (place.is)
        describe(reel, &place);
    describe_file(reel);
    tell(reel);
    pthread_mutex_unlock(&reel->mutex);
}

static bool is_asked(Reel *reel)
{
    pthread_mutex_lock(&reel->mutex);
    const bool asked = reel->quit || reel->asked != reel->answered;
    pthread_mutex_unlock(&reel->mutex);
    return asked;
}

/* Finds the next step to read ahead; returns false if all steps with room are kept. */
static bool find_next(Reel *reel, double time, double lead, size_t *index)
{
    Error none = {{0}};
    for (size_t k = 1; k + 2 <= reel->kept_most; k++) {
        if (!find(reel, time + (double)k * lead, index, &none))
            return false;
        if (!find_kept(reel, *index))
            return true;
    }
    return false;
}

/* Reads one step ahead; errors are reported when the step is requested. Returns false if there is no step
   to read, or kept steps are more useful. */
static bool read_ahead(Reel *reel, double time, double lead)
{
    Error none = {{0}};
    size_t index;
    if (lead == 0 || reel->shown == SIZE_MAX || !find_next(reel, time, lead, &index))
        return false;
    Kept *place = place_for(reel, reel->shown, lead);
    const Kept next = {.index = index};
    if (place->is && uselessness(place, reel->shown, lead) <= uselessness(&next, reel->shown, lead))
        return false;
    const bool read = read_into(reel, place, index, &none) != NULL;
    pthread_mutex_lock(&reel->mutex);
    reel->status.read += read;
    pthread_mutex_unlock(&reel->mutex);
    return read;
}

/* Notices a new file of the same name; the opened file is still shown. */
static void look_for_another(Reel *reel)
{
    struct stat now;
    const struct stat *then = &reel->file;
    if (reel->status.replaced || stat(reel->recorded.path, &now) != 0 ||
        (now.st_ino == then->st_ino && now.st_dev == then->st_dev))
        return;
    pthread_mutex_lock(&reel->mutex);
    reel->status.replaced = true;
    tell(reel);
    pthread_mutex_unlock(&reel->mutex);
}

/* Checks if the file has grown, as a run may still be writing. Read errors may vanish later. */
static void follow(Reel *reel)
{
    Error none = {{0}};
    const size_t steps = reel->recorded.steps;
    if (wall_ms() < reel->followed_ms + FOLLOW_MS)
        return;
    reel->followed_ms = wall_ms();
    look_for_another(reel);
    if (!recorded_follow(&reel->recorded, &none) || reel->recorded.steps == steps)
        return;
    pthread_mutex_lock(&reel->mutex);
    describe_file(reel);
    reel->asked++; /* the shown step has a new neighbour, and may not be the newest */
    tell(reel);
    pthread_mutex_unlock(&reel->mutex);
}

static void *work(void *user)
{
    Reel *reel = user;
    bool more = false; /* true: more steps to read ahead */
    hdf5_note_errors();
    for (;;) {
        pthread_mutex_lock(&reel->mutex);
        if (!more)
            wait_for_work(reel);
        const unsigned asked = reel->asked;
        const bool quit = reel->quit, wanted = asked != reel->answered;
        const double time = reel->time, lead = reel->lead;
        pthread_mutex_unlock(&reel->mutex);
        if (quit)
            return NULL;
        if (wanted)
            answer(reel, time, lead, asked);
        follow(reel);
        more = !is_asked(reel) && read_ahead(reel, time, lead);
    }
}

/* ---- functions of the context's thread ---- */

static bool make_upload(Reel *reel, size_t room, Error *error)
{
    Upload *upload = upload_create(room, reel->attributes, error);
    if (!upload)
        return false;
    if (reel->before)
        upload_destroy(reel->upload); /* never got a state */
    else
        reel->before = reel->upload;
    reel->upload = upload;
    reel->room = room;
    reel->needs = 0;
    reel->shown = SIZE_MAX;
    return true;
}

Reel *reel_create(const ReelSetup *setup, Error *error)
{
    Reel *reel = calloc(1, sizeof *reel);
    if (!reel) {
        error_set(error, "%s: out of memory", setup->recorded->path);
        return NULL;
    }
    reel->attributes = setup->attributes & setup->recorded->attributes;
    reel->bytes = setup->bytes;
    reel->at_or_after = setup->at_or_after;
    reel->wake = setup->wake;
    reel->kept_most = REEL_KEPT_MOST;
    reel->followed_ms = wall_ms();
    reel->recorded = *setup->recorded;
    if (stat(reel->recorded.path, &reel->file) != 0)
        reel->status.replaced = true; /* already gone: a replacement cannot be recognised */
    describe_file(reel);
    pthread_mutex_init(&reel->mutex, NULL);
    pthread_cond_init(&reel->wanted, NULL);
    pthread_cond_init(&reel->done, NULL);
    if (make_upload(reel, 1, error)) {
        if (pthread_create(&reel->thread, NULL, work, reel) == 0) {
            *setup->recorded = (Recorded){.reader = NULL};
            return reel;
        }
        error_set(error, "%s: no thread to read it with", setup->recorded->path);
    }
    upload_destroy(reel->upload);
    free(reel);
    return NULL;
}

void reel_destroy(Reel *reel)
{
    if (!reel)
        return;
    pthread_mutex_lock(&reel->mutex);
    reel->quit = true;
    pthread_cond_signal(&reel->wanted);
    pthread_mutex_unlock(&reel->mutex);
    pthread_join(reel->thread, NULL);
    for (size_t k = 0; k < REEL_KEPT_MOST; k++)
        still_free(&reel->kept[k].still);
    upload_destroy(reel->before);
    upload_destroy(reel->upload);
    recorded_close(&reel->recorded);
    pthread_cond_destroy(&reel->done);
    pthread_cond_destroy(&reel->wanted);
    pthread_mutex_destroy(&reel->mutex);
    free(reel);
}

void reel_seek(Reel *reel, double time, double lead)
{
    pthread_mutex_lock(&reel->mutex);
    if (reel->asked == 0 || time != reel->time || lead != reel->lead) {
        reel->time = time;
        reel->lead = lead;
        reel->asked++;
        pthread_cond_signal(&reel->wanted);
    }
    pthread_mutex_unlock(&reel->mutex);
}

/* Makes room for the requested step plus a quarter, as the next step may be larger. Call with the mutex
   locked. */
static bool make_room(Reel *reel, Error *error)
{
    if (reel->needs <= reel->room)
        return true;
    if (!make_upload(reel, reel->needs + reel->needs / 4, error))
        return false;
    pthread_cond_signal(&reel->wanted);
    return true;
}

bool reel_status(Reel *reel, ReelStatus *status, Error *error)
{
    pthread_mutex_lock(&reel->mutex);
    const bool ok = make_room(reel, error);
    *status = reel->status;
    status->answered = reel->asked == reel->answered;
    pthread_mutex_unlock(&reel->mutex);
    return ok;
}

bool reel_wait(Reel *reel, ReelStatus *status, Error *error)
{
    bool ok;
    pthread_mutex_lock(&reel->mutex);
    while ((ok = make_room(reel, error)) && reel->asked != reel->answered)
        pthread_cond_wait(&reel->done, &reel->mutex);
    *status = reel->status;
    status->answered = reel->asked == reel->answered;
    pthread_mutex_unlock(&reel->mutex);
    return ok && (!status->failed || error_set(error, "%s", status->message));
}

bool reel_fresh(Reel *reel)
{
    return upload_fresh(reel->upload);
}

bool reel_take(Reel *reel, ParticleBuffers *out)
{
    if (reel->before && !upload_fresh(reel->upload))
        return upload_take(reel->before, out);
    upload_destroy(reel->before);
    reel->before = NULL;
    return upload_take(reel->upload, out);
}

void reel_print_flaws(Reel *reel, FILE *file)
{
    pthread_mutex_lock(&reel->mutex);
    const SnapshotFlaws flaws = reel->flaws;
    pthread_mutex_unlock(&reel->mutex);
    snapshot_flaws_print(&flaws, reel->recorded.path, file);
}
