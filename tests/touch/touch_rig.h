/* Small worlds with touch, on every backend and with all supported methods. */
#ifndef SLOSH_TOUCH_RIG_H
#define SLOSH_TOUCH_RIG_H

#include "tests/sim/fixture.h"

#include "sim/state.h"

static const struct {
    const char *backend, *method;
} touch_forms[] = {
    {"cpu", "mueller"},      {"cpu", "wcsph"},       {"cpu", "dfsph"},
    {"cpu", "pbf"},          {"compute", "mueller"}, {"compute", "dfsph"},
    {"fragment", "mueller"}, {"compute", "wcsph"},   {"compute", "pbf"},
};
enum { TOUCH_FORMS = sizeof touch_forms / sizeof *touch_forms };

/* A free block in a box, without gravity: only the finger moves the block. */
static inline WorldDef touch_def(int form, int dimensions)
{
    WorldDef def = fixture_def(1.6, 1.6, 1.6);
    snprintf(def.backend, sizeof def.backend, "%s", touch_forms[form].backend);
    snprintf(def.method, sizeof def.method, "%s", touch_forms[form].method);
    def.dimensions = dimensions;
    memset(def.gravity, 0, sizeof def.gravity);
    const double deep = dimensions == 2 ? 0 : 0.4;
    fixture_block(&def, 0, -0.4, 0.4, -deep, 0.4, 1.2, deep);
    return def;
}

static inline Finger touch_at(FingerWay way, double x, double y, double z, double radius, double strength)
{
    return (Finger){.way = way, .at = {x, y, z}, .radius = radius, .strength = strength};
}

static inline FingerState touch_state(World *world)
{
    WorldNumbers numbers;
    world_save_numbers(world, &numbers);
    return numbers.finger;
}

#endif
