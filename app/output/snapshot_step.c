/* The arrays of a state in memory. */
#include "app/output/snapshot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void snapshot_step_free(SnapshotStep *step)
{
#define X(name, type, field) free(step->field);
    SNAPSHOT_FIELDS(X)
#undef X
    free(step->born);
    for (int k = 0; k < step->own_count; k++)
        free(step->own[k].values);
    for (int k = 0; k < step->shown_count; k++)
        free(step->shown[k].values);
    *step = (SnapshotStep){0};
}

void snapshot_floating(const SnapshotStep *step, BoxState floating[SOLIDS_MAX])
{
    for (int k = 0; k < SOLIDS_MAX; k++)
        floating[k] = step->restart.bodies.of[k].pose;
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

/* Adds the datasets of a column; three components are NAME_0, NAME_1, NAME_2, like the velocity. */
static bool add_own(SnapshotStep *step, const ColumnDef *column, size_t some)
{
    const int first = column_own(column);
    bool all = true;
    for (int c = 0; c < column->components; c++) {
        const int k = step->own_count++;
        snprintf(step->own[k].name, sizeof step->own[k].name, column->components > 1 ? "%s_%d" : "%s",
                 column->name, c);
        step->own[k].place = first + c;
        all &= (step->own[k].values = calloc(some, sizeof(float))) != NULL;
    }
    return all;
}

bool snapshot_step_own(SnapshotStep *step, const ColumnRows *saved)
{
    bool all = true;
    for (int k = 0; k < saved->count; k++)
        if (column_own(saved->row[k]) >= 0)
            all &= add_own(step, saved->row[k], step->count ? step->count : 1);
    return all;
}

bool snapshot_step_born(SnapshotStep *step)
{
    step->born = calloc(step->count ? step->count : 1, sizeof *step->born);
    return step->born != NULL;
}

float *snapshot_step_show(SnapshotStep *step, Scalar scalar)
{
    float *values = calloc(step->count ? step->count : 1, sizeof *values);
    if (!values)
        return NULL;
    step->shown[step->shown_count].scalar = scalar;
    return step->shown[step->shown_count++].values = values;
}

const float *snapshot_step_own_scalar(const SnapshotStep *step, Scalar scalar)
{
    for (int k = 0; k < step->shown_count; k++)
        if (step->shown[k].scalar == scalar)
            return step->shown[k].values;
    return NULL;
}

double snapshot_volume(const SnapshotScene *scene, const SnapshotStep *step, size_t i)
{
    const bool known = step->fluid[i] >= 0 && (size_t)step->fluid[i] < scene->fluid_count;
    const double relative = known ? step->density[i] / scene->density[step->fluid[i]] : NAN;
    const double number = 1 + (relative - 1) / scene->stiffness_scale;
    return pow(scene->spacing, scene->dimensions) / (number < 0.05 ? 0.05 : number);
}
