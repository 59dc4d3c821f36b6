#include "app/output/snapshot_sift.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

SnapshotFlaws snapshot_flaws(const SnapshotReader *reader, bool strict)
{
    SnapshotScene scene;
    SnapshotFlaws flaws = {.farthest = INFINITY, .fluids = SIZE_MAX, .strict = strict};
    if (!snapshot_read_scene(reader, &scene, NULL))
        return flaws;
    flaws.farthest = SIFT_BOXES * fmax(scene.box_size[0], fmax(scene.box_size[1], scene.box_size[2]));
    flaws.fluids = scene.fluid_count;
    return flaws;
}

/* The worst flaw of particle i; FLAW_COUNT: none. `dense`: the file has densities. */
static Flaw flaw_of(const SnapshotFlaws *flaws, const SnapshotStep *step, bool dense, size_t i)
{
    bool finite = isfinite(step->pressure[i]);
    for (int k = 0; k < 3; k++) {
        const double place = step->position[k][i];
        if (!isfinite(place) || fabs(place) > flaws->farthest)
            return FLAW_POSITION;
        finite = finite && isfinite(step->velocity[k][i]);
    }
    if (step->fluid[i] < 0 || (size_t)step->fluid[i] >= flaws->fluids)
        return FLAW_FLUID;
    if (dense && (!(step->density[i] > 0) || !isfinite(step->density[i])))
        return FLAW_DENSITY;
    return finite ? FLAW_COUNT : FLAW_NUMBER;
}

static bool is_left_out(const SnapshotFlaws *flaws, Flaw flaw)
{
    return flaw == FLAW_POSITION || (flaws->strict && flaw < FLAW_ID);
}

static void move(SnapshotStep *step, size_t from, size_t to)
{
#define X(name, type, field) step->field[to] = step->field[from];
    SNAPSHOT_FIELDS(X)
#undef X
    for (int k = 0; k < step->shown_count; k++)
        step->shown[k].values[to] = step->shown[k].values[from];
}

static int by_value(const void *a, const void *b)
{
    const int64_t one = *(const int64_t *)a, other = *(const int64_t *)b;
    return (one > other) - (one < other);
}

static bool count_ids(const SnapshotStep *step, size_t *repeated)
{
    int64_t *ids = malloc((step->count + 1) * sizeof *ids);
    if (!ids)
        return false;
    memcpy(ids, step->id, step->count * sizeof *ids);
    qsort(ids, step->count, sizeof *ids, by_value);
    for (size_t i = 1; i < step->count; i++)
        *repeated += ids[i] == ids[i - 1];
    free(ids);
    return true;
}

bool snapshot_sift(SnapshotFlaws *flaws, size_t index, SnapshotStep *step)
{
    const bool dense = !snapshot_step_lacks(step, "density");
    size_t found[FLAW_COUNT + 1] = {0}, kept = 0;
    flaws->dense = dense;
    for (size_t i = 0; i < step->count; i++) {
        const Flaw flaw = flaw_of(flaws, step, dense, i);
        found[flaw]++;
        if (!is_left_out(flaws, flaw))
            move(step, i, kept++);
    }
    step->count = kept;
    if (!flaws->shown && !count_ids(step, &found[FLAW_ID]))
        return false;
    for (int flaw = 0; flaw < FLAW_COUNT; flaw++) {
        if (found[flaw] > 0 && flaws->of[flaw].snapshots++ == 0)
            flaws->of[flaw].first = index;
        flaws->of[flaw].particles += found[flaw];
    }
    return true;
}

size_t snapshot_flaws_left_out(const SnapshotFlaws *flaws)
{
    size_t count = 0;
    for (int flaw = 0; flaw < FLAW_COUNT; flaw++)
        count += is_left_out(flaws, (Flaw)flaw) ? flaws->of[flaw].particles : 0;
    return count;
}

/* Prints the handling of a flaw's particles, as the end of a sentence. */
static void print_fate(const SnapshotFlaws *flaws, Flaw flaw, FILE *file)
{
    const bool one = flaws->of[flaw].particles == 1;
    const bool light = flaw == FLAW_DENSITY || (flaw == FLAW_FLUID && flaws->dense);
    if (is_left_out(flaws, flaw))
        fputs("left out\n", file);
    else if (flaws->summed && light)
        fprintf(file, "%s nothing in the slice\n", one ? "it weighs" : "they weigh");
    else
        fprintf(file, "%s as %s in the file\n", flaws->shown ? "shown" : "exported",
                one ? "it is" : "they are");
}

void snapshot_flaws_print(const SnapshotFlaws *flaws, const char *path, FILE *file)
{
    static const char *const words[] = {
        [FLAW_POSITION] = "a position that is not finite or more than 100 boxes away",
        [FLAW_FLUID] = "a fluid that the file does not know",
        [FLAW_DENSITY] = "a density that is not more than 0",
        [FLAW_NUMBER] = "a velocity or a pressure that is not finite",
        [FLAW_ID] = "the id of another one",
    };
    _Static_assert(SIFT_BOXES == 100, "the words say it");
    for (int flaw = 0; flaw < FLAW_COUNT; flaw++) {
        const size_t particles = flaws->of[flaw].particles, snapshots = flaws->of[flaw].snapshots;
        if (particles == 0)
            continue;
        fprintf(file, "%s: warning: %zu particle%s ", path, particles, particles == 1 ? "" : "s");
        if (snapshots > 1)
            fprintf(file, "in %zu snapshots, the first of them ", snapshots);
        else
            fputs("of ", file);
        fprintf(file, "Step#%zu%s %s %s; ", flaws->of[flaw].first, snapshots > 1 ? "," : "",
                particles == 1 ? "has" : "have", words[flaw]);
        print_fate(flaws, (Flaw)flaw, file);
    }
}
