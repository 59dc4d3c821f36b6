/* What in a snapshot no simulation writes: of a damaged file, or one that another program made. */
#ifndef SLOSH_SNAPSHOT_SIFT_H
#define SLOSH_SNAPSHOT_SIFT_H

#include "app/output/snapshot.h"

#include <stdio.h>

typedef enum Flaw {
    FLAW_POSITION, /* not finite, or SIFT_BOXES boxes away: always left out */
    FLAW_FLUID,    /* none of the file's */
    FLAW_DENSITY,  /* not more than 0, or not finite */
    FLAW_NUMBER,   /* velocity or pressure not finite */
    FLAW_ID,       /* of another particle too: stays */
    FLAW_COUNT
} Flaw;

enum { SIFT_BOXES = 100 };

/* What was found in the snapshots so far. */
typedef struct SnapshotFlaws {
    double farthest; /* from the box's origin along an axis, m; infinite where the file says nothing of its
                        box */
    size_t fluids;
    bool strict; /* particles with the three in the middle are left out too */
    bool summed; /* given: exported as sums, to which a particle whose mass or density is not known adds
                    nothing */
    bool dense;  /* the last snapshot has densities */
    bool shown;  /* not exported: ids are not compared, which would take longer than all else */
    struct {
        size_t particles, snapshots, first; /* the first snapshot with such particles */
    } of[FLAW_COUNT];
} SnapshotFlaws;

SnapshotFlaws snapshot_flaws(const SnapshotReader *reader, bool strict);

/* Counts the flaws of step `index`, and takes out of it what is left out. False when memory is short. */
bool snapshot_sift(SnapshotFlaws *flaws, size_t index, SnapshotStep *step);

/* How many particles were left out. */
size_t snapshot_flaws_left_out(const SnapshotFlaws *flaws);

/* A warning for each kind that was found. */
void snapshot_flaws_print(const SnapshotFlaws *flaws, const char *path, FILE *file);

#endif
