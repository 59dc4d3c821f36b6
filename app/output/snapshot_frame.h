/* The frame of reference of a step: the box's, as in snapshots, or the world's. */
#ifndef SLOSH_SNAPSHOT_FRAME_H
#define SLOSH_SNAPSHOT_FRAME_H

#include "app/output/snapshot.h"

/* X(NAME, name) */
#define SNAPSHOT_FRAMES(X)                                                                                   \
    X(BOX, "box")                                                                                            \
    X(WORLD, "world")

typedef enum SnapshotFrame {
#define X(NAME, name) FRAME_##NAME,
    SNAPSHOT_FRAMES(X)
#undef X
} SnapshotFrame;

const char *snapshot_frame_name(SnapshotFrame frame);

/* Transforms positions and velocities of a step from the file to the world's frame, with the step's pose and
   rates: a particle at rest in a turning box then moves. Gravity and pose stay unchanged. */
void snapshot_step_to_world(SnapshotStep *step);

#endif
