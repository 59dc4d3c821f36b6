/* Recorded runs: a state between two steps, and the playback of a snapshot file, with scene and states
   (Recorded), steps read ahead on a thread (Prefetch), and the time to show (Player). */
#ifndef APP_RUN_PLAYBACK_PLAYBACK_H
#define APP_RUN_PLAYBACK_PLAYBACK_H

#include "app/files/snapshot.h"
#include "app/scene/scene.h"
#include "render/particles/particles.h"
#include "sim/gpu/particle_buffers.h"
#include "sim/world.h"

/* Interpolation between two states: particles and box at a time between two steps. */

/* A state in memory; empty when zeroed. */
typedef struct StateCopy {
    ParticleBuffers state; /* attributes unused */
    ParticleArrays arrays; /* owned; velocity, fluid and id always, plus the requested scalars */
    size_t capacity;       /* particles */
} StateCopy;

void state_copy_free(StateCopy *copy);

/* Makes room for `count` particles with the attributes (PARTICLE_*). Returns false if memory is short. */
bool state_copy_reserve(StateCopy *copy, size_t count, unsigned attributes);

/* Reads the world's present state; waits for a GPU. Returns false if memory is short. */
bool state_copy_read(StateCopy *copy, World *world, unsigned attributes);

/* Interpolates both states at `time` (s). A particle, found by its id, follows the cubic curve with its
   positions and velocities at both states, the short way across periodic sides. The box and floating solids
   do the same. Scalars are interpolated linearly. A particle of one state only (emitted, drained) moves on
   with its velocity, and exists in the half of the step nearer to its state. `out` has room for the particles
   of both states. Returns false if memory is short. */
bool interpolate_states(const StateCopy *before, const StateCopy *after, const bool periodic[3], double time,
                        StateCopy *out);

/* Playback of a snapshot file: scene and states (Recorded), steps read ahead on a thread (Prefetch), and the
   time to show (Player). */

/* A file of snapshots, ready for views: scene, times, states.

   Reads on demand only: opening a file takes as long for 5,000 steps as for one, and a time is found by
   bisection. Use all functions from one thread at a time. */

/* Zeroed: closed. */
typedef struct Recorded {
    char path[1024];
    SnapshotReader *reader;
    bool foreign; /* not of slosh */
    SnapshotScene numbers;
    Scene scene;
    size_t steps;        /* at least 1 */
    double first, last;  /* times of Step#0 and of the last step, s */
    unsigned attributes; /* PARTICLE_*: attributes of the first step */
    SnapshotFlaws flaws; /* of the steps read so far; particles left out as flawed are not in the states */
} Recorded;

/* True if the name has the ending of a file of particles, or is a pattern of such names. */
bool recorded_is_file(const char *path);

/* True if both names are of files of the same format. */
bool recorded_is_alike(const char *one, const char *two);

/* Opens a file. `settings` and `notes` as in recorded_scene; attributes missing in the first step are
   noted in `notes`. Returns false with the reason: no file, no snapshot file, no complete step, not
   written by slosh. */
bool recorded_open(const char *path, const SceneSettings *settings, Recorded *out, Notes *notes,
                   Error *error);
void recorded_close(Recorded *recorded);

/* Returns true if the file has all attributes needed by the view; false with valid choices of colour, or
   with the key at fault. */
bool recorded_has(const Recorded *recorded, const ViewDef *view, Error *error);

/* Changes the view to need only existing attributes; each change is noted in `notes`. */
void recorded_adapt(const Recorded *recorded, ViewDef *view, Notes *notes);

bool recorded_time(Recorded *recorded, size_t index, double *time, Error *error);

/* Finds the newest step at or before `time` (s, within rounding); the first step if there is none. */
bool recorded_find(Recorded *recorded, double time, size_t *index, Error *error);

/* Finds the first step at or after `time`; the last step if there is none. */
bool recorded_find_after(Recorded *recorded, double time, size_t *index, Error *error);

/* Reads a state in the format of world_read: the available attributes of `attributes`, else NULL. Volumes
   come from densities (snapshot_volume); without fluid numbers all particles belong to the first fluid. */
bool recorded_read(Recorded *recorded, size_t index, unsigned attributes, StateCopy *out, Error *error);

/* Checks if the file has grown, and updates `steps` and `last`. Returns false as snapshot_refresh. */
bool recorded_follow(Recorded *recorded, Error *error);

/* The scene of a snapshot file, as needed by views. */

/* Builds the scene from the root's attributes: lengths and fluids with all bits, the rest from the file's
   settings (nine digits; colours three). `settings` (may be NULL) may set only keys of the view; any
   further key is refused by name, but those of recorded_assumptions if `foreign`. Missing or unknown settings
   of the file are noted in `notes` (may be NULL). Returns false with the reason. */
bool recorded_scene(const SnapshotReader *reader, const char *path, bool foreign,
                    const SceneSettings *settings, SnapshotScene *numbers, Scene *scene, Notes *notes,
                    Error *error);

/* Reads assumptions for a foreign file from settings (may be NULL). Returns false with the reason.
 */
bool recorded_assumptions(const char *path, const SceneSettings *settings, SnapshotAssumptions *out,
                          Error *error);

/* Prepares a recorded file's steps for pictures: a thread reads steps ahead, keeps a few, and writes the
   requested step into an Upload. The shown step is the newest at or before the requested time
   (PrefetchSetup.at_or_after: the first at or after the time), without interpolation.

   All functions here belong to one other thread, the thread of the GL context. */

enum { PREFETCH_CACHE_LEAST = 3, PREFETCH_CACHE_MOST = 32 };

typedef struct Prefetch Prefetch;

typedef struct PrefetchSetup {
    Recorded *recorded;  /* taken over and emptied if the prefetch could be made */
    unsigned attributes; /* PARTICLE_* read by pictures; attributes missing in the file are left out */
    size_t bytes;        /* memory for read steps: as many as fit, within PREFETCH_CACHE_LEAST and
                            PREFETCH_CACHE_MOST */
    bool at_or_after;    /* show the first step at or after the time, or the last step */
    void (*wake)(void);  /* called on its thread on any news; may be NULL */
} PrefetchSetup;

/* Starts the thread; nothing is shown yet. Returns NULL if memory is short. */
Prefetch *prefetch_create(const PrefetchSetup *setup, Error *error);
void prefetch_destroy(Prefetch *prefetch); /* NULL is allowed; waits for the step being read */

/* Requests the step for `time` (s). `lead`: expected advance to the next request, s, negative for
   backwards; steps are read ahead accordingly. 0: unknown. */
void prefetch_seek(Prefetch *prefetch, double time, double lead);

/* Present state of a prefetch. */
typedef struct PrefetchStatus {
    size_t steps;       /* known steps of the file */
    double first, last; /* times of the first and the last step, s */
    bool answered;      /* the last prefetch_seek is finished: `index` is shown, or it failed */
    bool failed;        /* `message` has the reason; the earlier step stays shown */
    char message[1024];
    size_t index;         /* of the shown step */
    double time;          /* time of the shown step, s; after a failure, of the failed step */
    double before, after; /* times of its neighbours; at the file's ends `time` itself */
    size_t particles;     /* of the shown step */
    uint64_t step;        /* the shown step's number in the run */
    bool replaced;        /* another file has the name now; the opened file is still shown */
    size_t read, found;   /* steps read; steps already in memory when requested */
    size_t cached_most;   /* greatest count of kept steps */
} PrefetchStatus;

/* Call before prefetch_take: allocates more GPU memory for a step with more particles than before. Returns
   false if memory is short. */
bool prefetch_status(Prefetch *prefetch, PrefetchStatus *status, Error *error);

/* Waits until the last prefetch_seek is finished. */
bool prefetch_wait(Prefetch *prefetch, PrefetchStatus *status, Error *error);

/* See upload_has_new and upload_take. */
bool prefetch_has_new(Prefetch *prefetch);
bool prefetch_take(Prefetch *prefetch, ParticleBuffers *out);

/* Prints a line for each kind of flaw in the steps read so far. */
void prefetch_print_flaws(Prefetch *prefetch, FILE *file);

/* Steps of a file between two pictures, for overlays following particles (OverlayKind.every). */

/* A callback for steps. */
typedef struct PrefetchObserver {
    void (*see)(void *user, const ParticleBuffers *particles);
    void *user;
} PrefetchObserver;

/* State of watching a prefetch. */
typedef struct PrefetchWatch {
    double every, before; /* interval of states for overlays, and time before a picture, s; INFINITY: none */
    double watched;       /* time of the last step seen by overlays, s; initially -INFINITY */
    bool skipped;         /* a step could not be read; reported */
} PrefetchWatch;

/* Shows the seer the steps before the picture at `time` (s); `status` is of the last of these steps.
   Returns false on failure. Unreadable steps are only reported on the terminal, once. */
bool prefetch_watch(PrefetchWatch *watch, Prefetch *prefetch, double time, const PrefetchObserver *seer,
                    PrefetchStatus *status, Error *error);

/* Plays a recorded run in time with the clock: chooses the file's time to show.

   All functions belong to the thread of the GL context. */

typedef struct Player Player;

/* Creates a player with a prefetch of all attributes in the file (see PrefetchSetup). Returns NULL with the
   reason; `recorded` then stays the caller's. */
Player *player_create(Recorded *recorded, void (*wake)(void), bool paused, Error *error);
void player_destroy(Player *player); /* NULL is allowed */

/* Advances to wall time `now_ms`. The file's time moves by `speed` times as much, at most a quarter of a
   second at once, and stops or restarts at the end. Returns the ms until the next step is due; INFINITY if
   the player rests, or a step waits for the thread. The thread calls wake when a step has been read. */
double player_work(Player *player, double now_ms);

void player_pause(Player *player, bool paused);
void player_set_speed(Player *player, double speed);
void player_set_loop(Player *player, bool loop); /* at the end; initially false */
void player_go_to(Player *player, double time);  /* s, clamped to the file's times */
void player_go_by(Player *player, double seconds);

/* Moves by `steps` steps, back if negative, then pauses; calls add up. `held`: a repeated key, ignored
   while a step waits. */
void player_step(Player *player, int steps, bool held);

typedef struct PlayerStatus {
    PrefetchStatus prefetch;
    bool paused, loop;
    bool rests; /* the requested step is shown, and no step is due without a command */
    double speed;
    double played_s;    /* played time of the file since the start, without jumps */
    unsigned failures;  /* count of steps that could not be shown (repeats in a row count once) and of
                           replacements of the file */
    char message[1024]; /* of the last failure */
} PlayerStatus;

void player_status(const Player *player, PlayerStatus *status);

bool player_has(const Player *player, const ViewDef *view, Error *error); /* see recorded_has */

/* See prefetch_has_new and prefetch_take. */
bool player_fresh(Player *player);
bool player_take(Player *player, ParticleBuffers *out);

#endif
