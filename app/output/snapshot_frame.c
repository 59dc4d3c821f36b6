#include "app/output/snapshot_frame.h"

const char *snapshot_frame_name(SnapshotFrame frame)
{
    static const char *const names[] = {
#define X(NAME, name) name,
        SNAPSHOT_FRAMES(X)
#undef X
    };
    return names[frame];
}

void snapshot_step_to_world(SnapshotStep *step)
{
    for (size_t i = 0; i < step->count; i++) {
        double x[3], v[3], x_world[3], v_world[3];
        for (int k = 0; k < 3; k++) {
            x[k] = step->position[k][i];
            v[k] = step->velocity[k][i];
        }
        box_to_world(&step->box, x, v, x_world, v_world);
        for (int k = 0; k < 3; k++) {
            step->position[k][i] = (float)x_world[k];
            step->velocity[k][i] = (float)v_world[k];
        }
    }
}
