#include "app/run/playback/playback.h"

#include "app/files/foreign/foreign.h"
#include "app/files/snapshot_hdf5.h"
#include "sim/world.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

static const double FOLLOW_MS = 500; /* interval of checks if the file has grown */

/* A step in memory. */
typedef struct CachedStep {
    bool is;
    size_t index;
    double before, after; /* times of the neighbour steps */
    StateCopy copy;
} CachedStep;

struct Prefetch {
    unsigned attributes;
    size_t bytes;
    bool at_or_after;
    void (*wake)(void);

    pthread_t thread;
    pthread_mutex_t mutex; /* guards all members down to the next blank line */
    pthread_cond_t wanted, done;
    double time, lead;
    unsigned asked, answered; /* counts of prefetch_seek */
    size_t capacity, needs;   /* particles: capacity of the upload; size of the requested step if larger */
    bool quit;
    PrefetchStatus status;
    SnapshotFlaws flaws; /* a copy */

    Upload *upload;    /* written by the thread; replaced while the thread waits for room */
    Upload *before;    /* the replaced upload, until the new upload has a state; or NULL */
    Recorded recorded; /* used by the thread only */
    struct stat file;  /* status of the file when opened */
    CachedStep cache[PREFETCH_CACHE_MOST];
    size_t kept_most;
    size_t shown;       /* step index in the file; SIZE_MAX: none */
    double followed_ms; /* wall time of the last check if the file has grown */
};

/* ---- steps ---- */

static size_t step_bytes(const StateCopy *copy)
{
    size_t bytes = sizeof(float[4]) + sizeof(float[4]) + 2 * sizeof(uint32_t);
    for (size_t s = 0; s < sizeof copy->arrays.scalar / sizeof *copy->arrays.scalar; s++)
        bytes += copy->arrays.scalar[s] ? sizeof(float) : 0;
    return bytes * (copy->capacity + 1);
}

static size_t clamp(size_t value, size_t least, size_t most)
{
    return value < least ? least : value > most ? most : value;
}

static CachedStep *find_kept(Prefetch *prefetch, size_t index)
{
    for (size_t k = 0; k < PREFETCH_CACHE_MOST; k++)
        if (prefetch->cache[k].is && prefetch->cache[k].index == index)
            return &prefetch->cache[k];
    return NULL;
}

/* Rank of a kept step for removal: steps behind, seen along `lead`, before steps ahead; far steps before
   near steps. */
static double uselessness(const CachedStep *cache, size_t index, double lead)
{
    const double ahead = (lead < 0 ? -1 : 1) * ((double)cache->index - (double)index);
    return ahead < 0 ? 1e18 - ahead : ahead;
}

/* Returns a place for one more step: free, or with the least useful step for a reader at `index`. */
static CachedStep *place_for(Prefetch *prefetch, size_t index, double lead)
{
    CachedStep *worst = &prefetch->cache[0];
    for (size_t k = 0; k < prefetch->kept_most; k++) {
        CachedStep *cache = &prefetch->cache[k];
        if (!cache->is)
            return cache;
        if (uselessness(cache, index, lead) > uselessness(worst, index, lead))
            worst = cache;
    }
    return worst;
}

static bool read_neighbours(Prefetch *prefetch, CachedStep *cache, Error *error)
{
    Recorded *recorded = &prefetch->recorded;
    cache->before = cache->after = cache->copy.state.time;
    return (cache->index == 0 || recorded_time(recorded, cache->index - 1, &cache->before, error)) &&
           (cache->index + 1 >= recorded->steps ||
            recorded_time(recorded, cache->index + 1, &cache->after, error));
}

/* Reduces the kept steps to as many as fit if all are as large as `kept`, which stays. */
static CachedStep *keep_fewer(Prefetch *prefetch, CachedStep *cache)
{
    const size_t most =
        clamp(prefetch->bytes / step_bytes(&cache->copy), PREFETCH_CACHE_LEAST, prefetch->kept_most);
    if (cache >= prefetch->cache + most) {
        const CachedStep other = prefetch->cache[0];
        prefetch->cache[0] = *cache;
        *cache = other;
        cache = &prefetch->cache[0];
    }
    for (size_t k = most; k < prefetch->kept_most; k++) {
        state_copy_free(&prefetch->cache[k].copy);
        prefetch->cache[k].is = false;
    }
    prefetch->kept_most = most;
    return cache;
}

static CachedStep *read_into(Prefetch *prefetch, CachedStep *cache, size_t index, Error *error)
{
    cache->is = recorded_read(&prefetch->recorded, index, prefetch->attributes, &cache->copy, error);
    cache->index = index;
    return cache->is ? keep_fewer(prefetch, cache) : NULL;
}

/* ---- the thread ---- */

/* Waits, for a limited time, until a step is requested. Call with the mutex locked. */
static void wait_for_work(Prefetch *prefetch)
{
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += (long)(1e6 * FOLLOW_MS);
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    while (!prefetch->quit && prefetch->asked == prefetch->answered &&
           pthread_cond_timedwait(&prefetch->wanted, &prefetch->mutex, &until) == 0)
        continue;
}

static void tell(Prefetch *prefetch)
{
    pthread_cond_broadcast(&prefetch->done);
    if (prefetch->wake)
        prefetch->wake();
}

/* Writes a step into the upload, after waiting for room. Returns false to end the thread. */
static bool show(Prefetch *prefetch, const CachedStep *cache, Error *error)
{
    const size_t count = cache->copy.state.count;
    pthread_mutex_lock(&prefetch->mutex);
    while (count > prefetch->capacity && !prefetch->quit) {
        prefetch->needs = count;
        tell(prefetch);
        pthread_cond_wait(&prefetch->wanted, &prefetch->mutex);
    }
    const bool goes_on = !prefetch->quit;
    pthread_mutex_unlock(&prefetch->mutex);
    if (!goes_on || prefetch->shown == cache->index)
        return goes_on;
    prefetch->shown = cache->index;
    return upload_write_arrays(prefetch->upload, &cache->copy.arrays, &cache->copy.state, error);
}

/* Updates the status, with the mutex locked: the requested place in the file, even if the step cannot be
   shown. */
static void describe(Prefetch *prefetch, const CachedStep *cache)
{
    PrefetchStatus *status = &prefetch->status;
    status->time = cache->copy.state.time;
    status->before = cache->before;
    status->after = cache->after;
    status->cached_most = prefetch->kept_most;
}

static void describe_file(Prefetch *prefetch)
{
    prefetch->status.steps = prefetch->recorded.steps;
    prefetch->status.first = prefetch->recorded.first;
    prefetch->status.last = prefetch->recorded.last;
    prefetch->flaws = prefetch->recorded.flaws;
}

static bool find(Prefetch *prefetch, double time, size_t *index, Error *error)
{
    return (prefetch->at_or_after ? recorded_find_after : recorded_find)(&prefetch->recorded, time, index,
                                                                         error);
}

/* Shows the last requested step; `place` gets its place in the file. Returns false with the reason, and
   `place` as far as known. */
static bool show_asked(Prefetch *prefetch, double time, double lead, CachedStep *place, bool *read,
                       Error *error)
{
    if (!find(prefetch, time, &place->index, error))
        return false;
    CachedStep *cache = find_kept(prefetch, place->index);
    *read = !cache;
    if (!cache)
        cache = read_into(prefetch, place_for(prefetch, place->index, lead), place->index, error);
    Error none; /* the first reason counts */
    double *at = &place->copy.state.time;
    place->is = recorded_time(&prefetch->recorded, place->index, at, cache ? error : &none) &&
                read_neighbours(prefetch, place, cache ? error : &none);
    return cache && place->is && show(prefetch, cache, error);
}

static void answer(Prefetch *prefetch, double time, double lead, unsigned asked)
{
    Error error = {{0}};
    CachedStep place = {.index = 0};
    bool read = false;
    const bool shown = show_asked(prefetch, time, lead, &place, &read, &error);
    pthread_mutex_lock(&prefetch->mutex);
    PrefetchStatus *status = &prefetch->status;
    prefetch->answered = asked;
    status->read += read;
    status->found += shown && !read;
    status->failed = !shown;
    status->index = shown ? place.index : status->index;
    if (shown) {
        const ParticleBuffers *state = &find_kept(prefetch, place.index)->copy.state;
        status->particles = state->count;
        status->step = state->step;
    }
    snprintf(status->message, sizeof status->message, "%s", error.message);
    if (place.is)
        describe(prefetch, &place);
    describe_file(prefetch);
    tell(prefetch);
    pthread_mutex_unlock(&prefetch->mutex);
}

static bool is_asked(Prefetch *prefetch)
{
    pthread_mutex_lock(&prefetch->mutex);
    const bool asked = prefetch->quit || prefetch->asked != prefetch->answered;
    pthread_mutex_unlock(&prefetch->mutex);
    return asked;
}

/* Finds the next step to read ahead; returns false if all steps with room are kept. */
static bool find_next(Prefetch *prefetch, double time, double lead, size_t *index)
{
    Error none = {{0}};
    for (size_t k = 1; k + 2 <= prefetch->kept_most; k++) {
        if (!find(prefetch, time + (double)k * lead, index, &none))
            return false;
        if (!find_kept(prefetch, *index))
            return true;
    }
    return false;
}

/* Reads one step ahead; errors are reported when the step is requested. Returns false if there is no step
   to read, or kept steps are more useful. */
static bool read_ahead(Prefetch *prefetch, double time, double lead)
{
    Error none = {{0}};
    size_t index;
    if (lead == 0 || prefetch->shown == SIZE_MAX || !find_next(prefetch, time, lead, &index))
        return false;
    CachedStep *place = place_for(prefetch, prefetch->shown, lead);
    const CachedStep next = {.index = index};
    if (place->is && uselessness(place, prefetch->shown, lead) <= uselessness(&next, prefetch->shown, lead))
        return false;
    const bool read = read_into(prefetch, place, index, &none) != NULL;
    pthread_mutex_lock(&prefetch->mutex);
    prefetch->status.read += read;
    pthread_mutex_unlock(&prefetch->mutex);
    return read;
}

/* Notices a new file of the same name; the opened file is still shown. */
static void look_for_another(Prefetch *prefetch)
{
    struct stat now;
    const struct stat *then = &prefetch->file;
    if (prefetch->status.replaced || foreign_is_pattern(prefetch->recorded.path) ||
        stat(prefetch->recorded.path, &now) != 0 ||
        (now.st_ino == then->st_ino && now.st_dev == then->st_dev))
        return;
    pthread_mutex_lock(&prefetch->mutex);
    prefetch->status.replaced = true;
    tell(prefetch);
    pthread_mutex_unlock(&prefetch->mutex);
}

/* Checks if the file has grown, as a run may still be writing. Read errors may vanish later. */
static void follow(Prefetch *prefetch)
{
    Error none = {{0}};
    const size_t steps = prefetch->recorded.steps;
    if (wall_ms() < prefetch->followed_ms + FOLLOW_MS)
        return;
    prefetch->followed_ms = wall_ms();
    look_for_another(prefetch);
    if (!recorded_follow(&prefetch->recorded, &none) || prefetch->recorded.steps == steps)
        return;
    pthread_mutex_lock(&prefetch->mutex);
    describe_file(prefetch);
    prefetch->asked++; /* the shown step has a new neighbour, and may not be the newest */
    tell(prefetch);
    pthread_mutex_unlock(&prefetch->mutex);
}

static void *work(void *user)
{
    Prefetch *prefetch = user;
    bool more = false; /* true: more steps to read ahead */
    hdf5_note_errors();
    for (;;) {
        pthread_mutex_lock(&prefetch->mutex);
        if (!more)
            wait_for_work(prefetch);
        const unsigned asked = prefetch->asked;
        const bool quit = prefetch->quit, wanted = asked != prefetch->answered;
        const double time = prefetch->time, lead = prefetch->lead;
        pthread_mutex_unlock(&prefetch->mutex);
        if (quit)
            return NULL;
        if (wanted)
            answer(prefetch, time, lead, asked);
        follow(prefetch);
        more = !is_asked(prefetch) && read_ahead(prefetch, time, lead);
    }
}

/* ---- functions of the context's thread ---- */

static bool make_upload(Prefetch *prefetch, size_t capacity, Error *error)
{
    Upload *upload = upload_create(capacity, prefetch->attributes, error);
    if (!upload)
        return false;
    if (prefetch->before)
        upload_destroy(prefetch->upload); /* never got a state */
    else
        prefetch->before = prefetch->upload;
    prefetch->upload = upload;
    prefetch->capacity = capacity;
    prefetch->needs = 0;
    prefetch->shown = SIZE_MAX;
    return true;
}

Prefetch *prefetch_create(const PrefetchSetup *setup, Error *error)
{
    Prefetch *prefetch = calloc(1, sizeof *prefetch);
    if (!prefetch) {
        error_set(error, "%s: out of memory", setup->recorded->path);
        return NULL;
    }
    prefetch->attributes = setup->attributes & setup->recorded->attributes;
    prefetch->bytes = setup->bytes;
    prefetch->at_or_after = setup->at_or_after;
    prefetch->wake = setup->wake;
    prefetch->kept_most = PREFETCH_CACHE_MOST;
    prefetch->followed_ms = wall_ms();
    prefetch->recorded = *setup->recorded;
    if (!foreign_is_pattern(prefetch->recorded.path) && stat(prefetch->recorded.path, &prefetch->file) != 0)
        prefetch->status.replaced = true; /* already gone: a replacement cannot be recognised */
    describe_file(prefetch);
    pthread_mutex_init(&prefetch->mutex, NULL);
    pthread_cond_init(&prefetch->wanted, NULL);
    pthread_cond_init(&prefetch->done, NULL);
    if (make_upload(prefetch, 1, error)) {
        if (pthread_create(&prefetch->thread, NULL, work, prefetch) == 0) {
            *setup->recorded = (Recorded){.reader = NULL};
            return prefetch;
        }
        error_set(error, "%s: no thread to read it with", setup->recorded->path);
    }
    upload_destroy(prefetch->upload);
    free(prefetch);
    return NULL;
}

void prefetch_destroy(Prefetch *prefetch)
{
    if (!prefetch)
        return;
    pthread_mutex_lock(&prefetch->mutex);
    prefetch->quit = true;
    pthread_cond_signal(&prefetch->wanted);
    pthread_mutex_unlock(&prefetch->mutex);
    pthread_join(prefetch->thread, NULL);
    for (size_t k = 0; k < PREFETCH_CACHE_MOST; k++)
        state_copy_free(&prefetch->cache[k].copy);
    upload_destroy(prefetch->before);
    upload_destroy(prefetch->upload);
    recorded_close(&prefetch->recorded);
    pthread_cond_destroy(&prefetch->done);
    pthread_cond_destroy(&prefetch->wanted);
    pthread_mutex_destroy(&prefetch->mutex);
    free(prefetch);
}

void prefetch_seek(Prefetch *prefetch, double time, double lead)
{
    pthread_mutex_lock(&prefetch->mutex);
    if (prefetch->asked == 0 || time != prefetch->time || lead != prefetch->lead) {
        prefetch->time = time;
        prefetch->lead = lead;
        prefetch->asked++;
        pthread_cond_signal(&prefetch->wanted);
    }
    pthread_mutex_unlock(&prefetch->mutex);
}

/* Makes room for the requested step plus a quarter, as the next step may be larger. Call with the mutex
   locked. */
static bool make_room(Prefetch *prefetch, Error *error)
{
    if (prefetch->needs <= prefetch->capacity)
        return true;
    if (!make_upload(prefetch, prefetch->needs + prefetch->needs / 4, error))
        return false;
    pthread_cond_signal(&prefetch->wanted);
    return true;
}

bool prefetch_status(Prefetch *prefetch, PrefetchStatus *status, Error *error)
{
    pthread_mutex_lock(&prefetch->mutex);
    const bool ok = make_room(prefetch, error);
    *status = prefetch->status;
    status->answered = prefetch->asked == prefetch->answered;
    pthread_mutex_unlock(&prefetch->mutex);
    return ok;
}

bool prefetch_wait(Prefetch *prefetch, PrefetchStatus *status, Error *error)
{
    bool ok;
    pthread_mutex_lock(&prefetch->mutex);
    while ((ok = make_room(prefetch, error)) && prefetch->asked != prefetch->answered)
        pthread_cond_wait(&prefetch->done, &prefetch->mutex);
    *status = prefetch->status;
    status->answered = prefetch->asked == prefetch->answered;
    pthread_mutex_unlock(&prefetch->mutex);
    return ok && (!status->failed || error_set(error, "%s", status->message));
}

bool prefetch_has_new(Prefetch *prefetch)
{
    return upload_has_new(prefetch->upload);
}

bool prefetch_take(Prefetch *prefetch, ParticleBuffers *out)
{
    if (prefetch->before && !upload_has_new(prefetch->upload))
        return upload_take(prefetch->before, out);
    upload_destroy(prefetch->before);
    prefetch->before = NULL;
    return upload_take(prefetch->upload, out);
}

void prefetch_print_flaws(Prefetch *prefetch, FILE *file)
{
    pthread_mutex_lock(&prefetch->mutex);
    const SnapshotFlaws flaws = prefetch->flaws;
    pthread_mutex_unlock(&prefetch->mutex);
    snapshot_flaws_print(&flaws, prefetch->recorded.path, file);
}

/* Shows the seer the requested step, unless seen before. */
static bool watch_step(PrefetchWatch *watch, Prefetch *prefetch, double least, const PrefetchObserver *seer,
                       PrefetchStatus *status, Error *error)
{
    ParticleBuffers particles;
    if (!prefetch_wait(prefetch, status, error)) {
        if (status->failed && !watch->skipped)
            fprintf(stderr, "%s; overlays do without it\n", status->message);
        watch->skipped |= status->failed;
        return status->failed;
    }
    if (status->time < fmax(least, watch->watched + 0.999 * watch->every) || status->time <= watch->watched ||
        !prefetch_take(prefetch, &particles))
        return true;
    seer->see(seer->user, &particles);
    watch->watched = status->time;
    return true;
}

bool prefetch_watch(PrefetchWatch *watch, Prefetch *prefetch, double time, const PrefetchObserver *seer,
                    PrefetchStatus *status, Error *error)
{
    const double least = time - watch->before - 1e-9 * fmax(fabs(time), 1);
    double at = fmax(least, watch->watched), lead = 0;
    while (at < time && !isinf(watch->every)) {
        prefetch_seek(prefetch, at, lead);
        if (!watch_step(watch, prefetch, least, seer, status, error))
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
