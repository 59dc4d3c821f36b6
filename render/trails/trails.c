#include "render/trails/trails_def.h"

#include "render/trails/trail_lines.h"
#include "render/trails/trail_store.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct Trails {
    TrailStore store;
    TrailLines lines;
} Trails;

static void destroy(void *state)
{
    Trails *trails = state;
    trail_store_destroy(&trails->store);
    trail_lines_destroy(&trails->lines);
    free(trails);
}

static void *create(const Subject *subject, Error *error)
{
    Trails *trails = calloc(1, sizeof *trails);
    if (!trails) {
        error_set(error, "out of memory for trails");
        return NULL;
    }
    if (trail_store_create(&trails->store, subject, error) && trail_lines_create(&trails->lines, error))
        return trails;
    destroy(trails);
    return NULL;
}

static bool check(const Subject *subject, const char **key, Error *error)
{
    uint32_t ids[TRAILS_LISTED_MAX];
    *key = "view.trails.ids";
    return trails_listed(trails_def(subject->def), ids) >= 0 ||
           error_set(error, "\"%s\" is no list of at most %d ids; \"3 17 250\" is one, and all is by stride",
                     trails_def(subject->def)->ids, TRAILS_LISTED_MAX);
}

static double every(const ViewDef *def, double *before)
{
    *before = trails_def(def)->length;
    return trails_every(trails_def(def));
}

static void take(void *state, const ParticleBuffers *particles, const Subject *subject, GlTimer *timer)
{
    Trails *trails = state;
    GL_STAGE(timer, STAGE_OVERLAY)
    trail_store_take(&trails->store, particles, subject->def);
}

static void draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    Trails *trails = state;
    (void)particles;
    GL_STAGE(frame->timer, STAGE_OVERLAY)
    trail_lines_draw(&trails->lines, &trails->store, frame);
}

/* What is not as the keys say. */
static void legend(void *state, const Frame *frame, char *line, size_t size)
{
    const TrailStore *store = &((const Trails *)state)->store;
    if (store->listed_count < 0)
        snprintf(line, size, "trails: \"%s\" is no list of at most %d ids", trails_def(frame->def)->ids,
                 TRAILS_LISTED_MAX);
    else if (store->slots == 0 && store->capacity > 0)
        snprintf(line, size, "trails: the GPU has no memory for them");
    else if (store->slots > 0 && store->stride > trails_def(frame->def)->stride)
        snprintf(line, size, "trails of every %dth particle: more than %d have no room", store->stride,
                 store->slots);
}

static void wants(const ViewDef *def, ParticleWants *wants)
{
    (void)def;
    wants->attributes |= PARTICLE_ID;
}

const OverlayKind overlay_trails = {
    .name = "trails",
    .help = "paths of particles, faded with age",
    .keys = trails_keys,
    .def = &trails_usual,
    .def_size = sizeof trails_usual,
    .wants = wants,
    .check = check,
    .every = every,
    .create = create,
    .destroy = destroy,
    .take = take,
    .draw = draw,
    .legend = legend,
};
