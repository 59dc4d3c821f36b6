/* The frame of reference of a step: the box's, as snapshots have it, or the world's. */
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

/* Positions and velocities of a step as it was read become those in the world's frame, by the pose and the
   rates that it has: a particle at rest in a box that turns then moves. Gravity and pose stay as they are. */
void snapshot_step_to_world(SnapshotStep *step);

#endif
