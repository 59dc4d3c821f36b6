/* A file of snapshots, ready for views: scene, times, states.

   Reads on demand only: opening a file takes as long for 5,000 steps as for one, and a time is found by
   bisection. Use all functions from one thread at a time. */
#ifndef SLOSH_RECORDED_H
#define SLOSH_RECORDED_H

#include "app/files/snapshot.h"
#include "app/scene/scene.h"
#include "app/session/between.h"

/* Zeroed: closed. */
typedef struct Recorded {
    char path[1024];
    SnapshotReader *reader;
    SnapshotScene numbers;
    Scene scene;
    size_t steps;        /* at least 1 */
    double first, last;  /* times of Step#0 and of the last step, s */
    unsigned attributes; /* PARTICLE_*: attributes of the first step */
    SnapshotFlaws flaws; /* of the steps read so far; particles left out as flawed are not in the states */
} Recorded;

/* True if the name has the ending of a snapshot file. */
bool recorded_is_file(const char *path);

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
bool recorded_read(Recorded *recorded, size_t index, unsigned attributes, Still *out, Error *error);

/* Checks if the file has grown, and updates `steps` and `last`. Returns false as snapshot_refresh. */
bool recorded_follow(Recorded *recorded, Error *error);

#endif
