/* The arrays of one state in memory. */
#include "app/output/snapshot.h"

#include <math.h>
#include <stdlib.h>

void snapshot_step_free(SnapshotStep *step)
{
#define X(name, type, field) free(step->field);
    SNAPSHOT_FIELDS(X)
#undef X
    *step = (SnapshotStep){0};
}

bool snapshot_step_allocate(SnapshotStep *step, size_t count)
{
    size_t some = count ? count : 1;
    bool all = true;
    *step = (SnapshotStep){.count = count};
#define X(name, type, field)                                                                                 \
    step->field = calloc(some, sizeof(type));                                                                \
    all = all && step->field;
    SNAPSHOT_FIELDS(X)
#undef X
    if (!all)
        snapshot_step_free(step);
    return all;
}

double snapshot_volume(const SnapshotScene *scene, const SnapshotStep *step, size_t i)
{
    const bool known = step->fluid[i] >= 0 && (size_t)step->fluid[i] < scene->fluid_count;
    const double relative = known ? step->density[i] / scene->density[step->fluid[i]] : NAN;
    const double number = 1 + (relative - 1) / scene->compression, s = scene->spacing;
    return s * s * s / (number < 0.05 ? 0.05 : number);
}
