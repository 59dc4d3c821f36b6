/* Finds flaws in a snapshot that no simulation writes: damaged files, files of other programs. */
#ifndef SLOSH_SNAPSHOT_SIFT_H
#define SLOSH_SNAPSHOT_SIFT_H

#include "app/output/snapshot.h"

#include <stdio.h>

typedef enum Flaw {
    FLAW_POSITION, /* not finite, or SIFT_BOXES boxes away: always left out */
    FLAW_FLUID,    /* not among the file's fluids */
    FLAW_DENSITY,  /* not more than 0, or not finite */
    FLAW_NUMBER,   /* velocity or pressure not finite */
    FLAW_ID,       /* repeated id: the particle stays */
    FLAW_COUNT
} Flaw;

enum { SIFT_BOXES = 100 };

/* Flaws found in the snapshots so far. */
typedef struct SnapshotFlaws {
    double farthest; /* from the box's origin along an axis, m; infinite if the file has no box */
    size_t fluids;
    bool strict; /* particles with the middle three flaws are left out too */
    bool summed; /* given: exported as sums, where particles of unknown mass or density add nothing */
    bool dense;  /* the last snapshot has densities */
    bool shown;  /* for display: ids are not compared, which would be the slowest check */
    struct {
        size_t particles, snapshots, first; /* the first snapshot with such particles */
    } of[FLAW_COUNT];
} SnapshotFlaws;

SnapshotFlaws snapshot_flaws(const SnapshotReader *reader, bool strict);

/* Counts the flaws of step `index`, and removes particles to leave out. Returns false if memory is short. */
bool snapshot_sift(SnapshotFlaws *flaws, size_t index, SnapshotStep *step);

/* Count of particles left out. */
size_t snapshot_flaws_left_out(const SnapshotFlaws *flaws);

/* Prints a warning for each kind of flaw found. */
void snapshot_flaws_print(const SnapshotFlaws *flaws, const char *path, FILE *file);

#endif
