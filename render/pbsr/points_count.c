#include "render/pbsr/points_count.h"

#include <epoxy/gl.h>
#include <stdlib.h>

static uint64_t covered_by(const SetImage *image, size_t pixels)
{
    uint64_t covered = 0;
    for (size_t i = 0; i < pixels; i++)
        covered += image->depth[i] != 0;
    return covered;
}

/* Expected points of a set: nearer points are kept with higher probability. */
static double expected_of(const StillLayer *still, const SetSight *sight)
{
    const float *row = sight->row[2];
    double all = 0;
    for (size_t i = 0; still->sets > 0 && i < still->points.count; i++) {
        const float *at = still->points.point[i].position;
        const double w = (double)(row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3]);
        const double have = still->density * (double)sight->pixel * w * w;
        const double wanted = still->wanted * (double)still_layer_boost(still, &still->points.point[i]);
        all += have > wanted ? wanted / have : 1;
    }
    return still->sets > 0 ? all / still->sets : 0;
}

/* Reads points from GL memory into `copy`; the caller frees copy->points. */
static bool here(const StillLayer *still, StillLayer *copy)
{
    *copy = *still;
    if (!still->buffer)
        return true;
    copy->points = (SurfacePoints){still->count, still->count, malloc(still->count * sizeof(SurfacePoint))};
    if (copy->points.point)
        glGetNamedBufferSubData(still->buffer, 0, (GLsizeiptr)(still->count * sizeof(SurfacePoint)),
                                copy->points.point);
    return copy->points.point != NULL;
}

/* Adds the points that a set has of a layer. */
static bool add_set(const Layer *layer, const StillLayer *still, const SetSight *sight, const SetImage *image,
                    double *points)
{
    StillLayer copy;
    if (!here(still, &copy))
        return false;
    *points +=
        (double)layer_project(layer_pieces(still, layer), 0, 0, layer_pieces_sight(still, sight), image) +
        expected_of(&copy, &still->sight);
    still_layer_project(&copy, 0, 0, image);
    if (still->buffer)
        surface_points_free(&copy.points);
    return true;
}

bool points_count(const FluidLayers *layers, const FluidWalk walks[], const StillLayer still[],
                  const SolidLayers *solids, const SetSight *sight, int sets, const Frame *frame)
{
    const size_t pixels = (size_t)sight->width * (size_t)sight->height;
    const SetImage image = {.depth = malloc(pixels * sizeof *image.depth),
                            .word = malloc(pixels * sizeof *image.word)};
    bool ok = image.depth && image.word;
    const Layer none = {.point = NULL};
    double points = 0;
    if (ok)
        set_image_clear(&image, sight);
    for (int i = 0; ok && i < layers->count; i++)
        ok = walks[i].walks ? add_set(&none, &walks[i].still, sight, &image, &points)
                            : add_set(&layers->layers[i], &still[i], sight, &image, &points);
    for (int i = 0; ok && i < solids->count; i++)
        ok = add_set(&none, &solids->still[i], sight, &image, &points);
    if (ok) {
        frame->counts->fragments[STAGE_BLEND] = points * sets;
        counts_finish(frame->counts, covered_by(&image, pixels),
                      (uint64_t)frame->width * (uint64_t)frame->height);
    }
    free(image.depth);
    free(image.word);
    return ok;
}
