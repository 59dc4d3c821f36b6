/* Keys of the probes. */
#include "app/probe/probe_def.h"
#include "sim/base/key_rows.h"

#include <stdio.h>
#include <string.h>

#define AT(field)    offsetof(ProbeList, field)
#define PROBE(field) offsetof(ProbeDef, field)

enum { PLACES = 9 }; /* default count: of a line; per side of a plane */

const ProbeFieldRow probe_fields[] = {
#define X(NAME, name, unit, components) {name, unit, components},
    PROBE_FIELD_LIST(X)
#undef X
        {.name = NULL}};

/* Keys of each kind. */
#define PLACE_OF(S, HELP)    VEC3(S ".at", R | I, "m", -1e6, 1e6, PROBE(at), HELP),
#define SIDE(S, NAME, HELP)  VEC3(S "." #NAME, R | I, "m", -1e6, 1e6, PROBE(NAME), HELP),
#define COUNT(S, MOST, HELP) INTEGER(S ".count", I, 2, MOST, PROBE(count), HELP),
#define FIELDS_POINT(S)      PLACE_OF(S, "the place, on a wall or in the fluid")
#define FIELDS_HEIGHT(S)     PLACE_OF(S, "the foot: the height counts from here straight up, along the box's y")
#define FIELDS_LINE(S)                                                                                       \
    SIDE(S, from, "its first place")                                                                         \
    SIDE(S, to, "its last place") COUNT(S, PROBE_LINE_MAX, "places")
#define FIELDS_PLANE(S)                                                                                      \
    PLACE_OF(S, "its middle")                                                                                \
    SIDE(S, along, "one side, from end to end")                                                              \
    SIDE(S, across, "the other one; in two dimensions [0, 0]: a strip of length `along`")                    \
    COUNT(S, PROBE_PLANE_MAX, "places along each side")
#define FIELDS_FORCE(S)                                                                                      \
    TEXT(                                                                                                    \
        S ".on", I, PROBE_ON_SIZE, PROBE(on), "box",                                                         \
        "box: all its walls together, the torque about its origin; solid_0, solid_1: a solid by its number, about its own centre"),
#define PROBE_ROWS(KIND, NAME, HELP)                                                                         \
    VARIANT("probes[]." NAME, PROBE(kind), PROBE_##KIND, HELP), FIELDS_##KIND("probes[]." NAME)

static void probe_init(void *element, int index)
{
    ProbeDef *probe = element;
    (void)index;
    snprintf(probe->on, sizeof probe->on, "box");
    probe->count = PLACES;
    probe->field_count = 1;
    probe->fields[0] = PROBE_PRESSURE;
}

double probe_size(const ProbeDef *probe, double spacing, double support)
{
    const double least = 4 * spacing, own = support > 3 ? 2 * support * spacing : 6 * spacing;
    return probe->size == 0 ? own : probe->size < least ? least : probe->size;
}

int probe_on(const ProbeDef *probe, int solids)
{
    int number, length = 0;
    if (strcmp(probe->on, "box") == 0)
        return -1;
    const bool named = sscanf(probe->on, "solid_%3d%n", &number, &length) == 1 && !probe->on[length];
    return named && number >= 0 && number < solids ? number : -2;
}

bool probe_list_feels(const ProbeList *list)
{
    for (int k = 0; k < list->count; k++)
        if (list->probe[k].kind == PROBE_FORCE)
            return true;
    return false;
}

/* clang-format off */
const Key probe_keys[] = {
    LIST("probes", I, 0, PROBES_MAX, AT(probe), AT(count), ProbeDef, probe_init,
         "what slosh run --probes FILE reads of the fluid after each step, and the panel shows; at rest in the box's frame; each has one kind"),
    TEXT("probes[].name", R | I, PROBE_NAME_SIZE, PROBE(name), NULL, "letters, digits and _; each its own: columns are called by it"),
    PROBE_KIND_LIST(PROBE_ROWS)
    NAMES_OF("probes[].fields", 1, PROBE_FIELD_COUNT, probe_fields, PROBE(fields), PROBE(field_count),
             "what is read; a height and a force have none", .flags = I, .fallback = "[pressure]"),
    NUMBER("probes[].size", I, "m", 0, 100, PROBE(size),
           "diameter of the ball around each place whose fluid counts, less outwards; 0: 6 spacings, or twice the support radius; at least 4 spacings"),
    NUMBER("probes[].average", I, "s", 0, 1e6, PROBE(average),
           "beside each value its mean over the last so many seconds; 0: none"),
    KEYS_END,
};
/* clang-format on */
