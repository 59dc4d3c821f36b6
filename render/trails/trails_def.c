#include "render/trails/trails_def.h"

#include "sim/base/key_rows.h"

#include <limits.h>
#include <math.h>
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
    NUMBER("view.trails.every", L, "s", 0, 1000, AT(every), "between two points, at least; 0: 64 in a trail"),
    NUMBER("view.trails.width", L | O, "pixels", 0, 50, AT(width), "of the lines"),
    INTEGER("view.trails.moving", L, 0, 100000000, AT(moving), "pieces in a picture of the window while camera or box move, where the CPU draws them: fewer and longer ones than at rest; 0: all"),
    NUMBER("view.trails.through", L, "", 0, 1, AT(through), "how much shows of what fluid and solids hide"),
    VEC3("view.trails.region_min", L, "m", -1e6, 1e6, AT(region_min), "the least corner of a box: only particles have one that are in there when they are let in or these keys change; equal corners: all"),
    VEC3("view.trails.region_max", L, "m", -1e6, 1e6, AT(region_max), "its greatest corner"),
    VEC3("view.trails.plane_point", L, "m", -1e6, 1e6, AT(plane_point), "of a plane: only particles have one that cross it, from there on"),
    VEC3("view.trails.plane_normal", L, "", -1e6, 1e6, AT(plane_normal), "across this plane; of length 0: all have one"),
    KEYS_END,
};
/* clang-format on */

TrailsDef *trails_def(const ViewDef *def)
{
    return overlay_own(def, &overlay_trails);
}

int trails_listed(const TrailsDef *def, uint32_t ids[TRAILS_LISTED_MAX])
{
    int count = 0;
    const char *at = def->ids + strspn(def->ids, " ,");
    if (strcmp(def->ids, "all") == 0)
        return 0;
    while (*at) {
        char *end = NULL;
        const unsigned long long id = *at >= '0' && *at <= '9' ? strtoull(at, &end, 10) : ULLONG_MAX;
        if (id > INT64_MAX || count == TRAILS_LISTED_MAX || !strchr(" ,", *end))
            return -1;
        ids[count++] = (uint32_t)id; /* as buffers have them: 32 of 64 bits */
        at = end + strspn(end, " ,");
    }
    return count > 0 ? count : -1;
}

double trails_every(const TrailsDef *def)
{
    enum { USUAL_POINTS = 64 };
    const double least = def->length / (TRAILS_POINTS_MAX - 2);
    return fmax(def->every > 0 ? def->every : def->length / USUAL_POINTS, least);
}

int trails_points(const TrailsDef *def)
{
    return (int)fmin(ceil(def->length / trails_every(def)), TRAILS_POINTS_MAX - 2) + 2;
}
