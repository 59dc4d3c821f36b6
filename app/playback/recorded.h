/* A file of snapshots as views see it: its scene, its times, its states.

   Nothing is read but what is asked for: opening a file takes as long for 5,000 steps as for one, and a time
   is found by halving. All functions are for one thread at a time. */
#ifndef SLOSH_RECORDED_H
#define SLOSH_RECORDED_H

#include "app/output/snapshot_sift.h"
#include "app/scene/scene.h"
#include "app/session/between.h"

/* Zeroed it is closed. */
typedef struct Recorded {
    char path[1024];
    SnapshotReader *reader;
    SnapshotScene numbers;
    Scene scene;
    size_t steps;        /* at least 1 */
    double first, last;  /* times of Step#0 and of the last one, s */
    unsigned attributes; /* PARTICLE_*: what its first step has */
    SnapshotFlaws flaws; /* of what was read; particles that it says are left out are not in the states */
} Recorded;

/* Whether the name is that of such a file, by its end. */
bool recorded_is_file(const char *path);

/* `settings` and `notes` as of recorded_scene. What the first step lacks is a line of `notes`. False with the
   reason: no file, none of snapshots, no whole step, not slosh's. */
bool recorded_open(const char *path, const SceneSettings *settings, Recorded *out, Notes *notes,
                   Error *error);
void recorded_close(Recorded *recorded);

/* Whether it has what that view reads of a state; false with what the view may be coloured by, or the key at
   fault. */
bool recorded_has(const Recorded *recorded, const ViewDef *view, Error *error);

/* Changes the view to one that it has all for; each change is a line of `notes`. */
void recorded_adapt(const Recorded *recorded, ViewDef *view, Notes *notes);

bool recorded_time(Recorded *recorded, size_t index, double *time, Error *error);

/* The newest step at or before `time` (s, give or take what rounding does to it); the first where none is. */
bool recorded_find(Recorded *recorded, double time, size_t *index, Error *error);

/* The first step at or after `time`; the last where none is. */
bool recorded_find_after(Recorded *recorded, double time, size_t *index, Error *error);

/* The state as world_read would give it: those of `attributes` that the file has, and others NULL. Volumes
   follow from densities (snapshot_volume); without fluids all are of the first. */
bool recorded_read(Recorded *recorded, size_t index, unsigned attributes, Still *out, Error *error);

/* Looks whether the file has grown: `steps` and `last` follow. False as of snapshot_follow. */
bool recorded_follow(Recorded *recorded, Error *error);

#endif
