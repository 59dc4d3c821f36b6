#include "render/overlays/trails/trails.h"

#include "render/overlays/trails/trails_private.h"
#include "sim/base/key_rows.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A trail of a second with a point per picture of a window; during motion as many pieces as two processors
   draw in some 5 ms. */
const TrailsDef trails_usual = {.stride = 20, .length = 1, .width = 1.5, .moving = 50000, .ids = "all"};

#define AT(field) offsetof(TrailsDef, field)

/* clang-format off */
const Key trails_keys[] = {
    MAPPING("view.trails", "of the overlay trails: the paths of particles, beside any view"),
    BOOLEAN("view.trails.show", L, AT(show), "draw them"),
    INTEGER("view.trails.stride", L, 1, 1000000, AT(stride), "every so many particles, by their ids, has one; more than 20,000 at once there are not"),
    TEXT("view.trails.ids", L | KEY_WORDS, TRAILS_IDS_SIZE, AT(ids), NULL, "all: by stride; or the ids of up to 16 particles, as [3, 17, 250]: only these have one"),
    NUMBER("view.trails.length", L | O, "s", 0, 1000, AT(length), "from the particle back; older parts have faded"),
    NUMBER("view.trails.every", L, "s", 0, 1000, AT(every), "between two points, at least; auto, 0: 64 in a trail", .zero = "auto"),
    NUMBER("view.trails.width", L | O, "pixels", 0, 50, AT(width), "of the lines"),
    INTEGER("view.trails.moving", L, 0, 100000000, AT(moving), "pieces in a picture of the window while camera or box move, where the CPU draws them: fewer and longer ones than at rest; 0: all of them", .zero = "all"),
    NUMBER("view.trails.through", L, "", 0, 1, AT(through), "how much shows of what fluid and solids hide"),
    VEC3("view.trails.region_min", L, "m", -1e6, 1e6, AT(region_min), "the least corner of a box: only particles have one that are in there when they are let in or these keys change; equal corners: all"),
    VEC3("view.trails.region_max", L, "m", -1e6, 1e6, AT(region_max), "its greatest corner"),
    VEC3("view.trails.plane_point", L, "m", -1e6, 1e6, AT(plane_point), "of a plane: only particles have one that cross it, from there on"),
    VEC3("view.trails.plane_normal", L, "", -1e6, 1e6, AT(plane_normal), "across this plane; of length 0: all have one"),
    KEYS_END,
};
/* clang-format on */

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
    return trails_listed_ids(trails_def(subject->def), ids) >= 0 ||
           error_set(error, "\"%s\" is no list of at most %d ids; [3, 17, 250] is one, and all is by stride",
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
    trail_store_add_state(&trails->store, particles, subject->def);
}

static void draw(void *state, const ParticleBuffers *particles, const Frame *frame)
{
    Trails *trails = state;
    (void)particles;
    GL_STAGE(frame->timer, STAGE_OVERLAY)
    trail_lines_draw(&trails->lines, &trails->store, frame);
}

static bool unfinished(const void *state)
{
    return trail_lines_unfinished(&((const Trails *)state)->lines);
}

/* Reports differences from the keys. */
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

/* Returns false, and adds nothing, if the list is full. */
static bool add_id(char list[TRAILS_IDS_SIZE], uint32_t id)
{
    const size_t used = strlen(list), capacity = TRAILS_IDS_SIZE - used;
    const int needs = snprintf(list + used, capacity, "%s%u", used ? " " : "", id);
    const bool fits = needs >= 0 && (size_t)needs < capacity;
    if (!fits)
        list[used] = 0;
    return fits;
}

/* Writes the list of ids without `id`; returns true if `id` was in the list. */
static bool without(const uint32_t ids[], int count, uint32_t id, char list[TRAILS_IDS_SIZE])
{
    bool was = false;
    *list = 0;
    for (int i = 0; i < count; i++) {
        was |= ids[i] == id;
        if (ids[i] != id)
            add_id(list, ids[i]);
    }
    return was;
}

#define IDS_ARE "view.trails.ids="
_Static_assert(sizeof((ViewSetting *)0)->text >= sizeof IDS_ARE + TRAILS_IDS_SIZE, "a full list fits");

/* Adds the particle's trail to the shown trails, or removes the trail. If trails were by stride, the
   particle's trail becomes the only one. */
static int choose(const ViewDef *def, uint32_t id, ViewSetting settings[VIEW_SETTINGS_MAX], char words[160])
{
    const TrailsDef *own = trails_def(def);
    uint32_t ids[TRAILS_LISTED_MAX];
    char list[TRAILS_IDS_SIZE];
    const int listed = trails_listed_ids(own, ids), count = own->show && listed > 0 ? listed : 0;
    const bool was = without(ids, count, id, list);
    if (!was && (count == TRAILS_LISTED_MAX || !add_id(list, id))) {
        snprintf(words, 160,
                 "%d particles have a trail, and no more can; a click on one of them takes its away", count);
        return 0;
    }
    snprintf(words, 160, "particle %u has %s%s", id, was ? "no trail any more" : "a trail",
             was && !*list                      ? "; it was the last"
             : !was && own->show && listed == 0 ? ", and it alone: those by stride are gone"
                                                : "");
    snprintf(settings[0].text, sizeof settings[0].text, IDS_ARE "%s", *list ? list : "all");
    snprintf(settings[1].text, sizeof settings[1].text, "view.trails.show=%s", *list ? "true" : "false");
    return 2;
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
    .unfinished = unfinished,
    .choose = choose,
    .legend = legend,
};
