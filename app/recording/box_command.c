#include "app/recording/box_command.h"

#include "sim/world/world_state.h"

#include <math.h>
#include <string.h>

static bool check(const double size[3], const WorldDef *def, Error *error)
{
    for (int k = 0; k < def->dimensions; k++) {
        if (!isfinite(size[k]) || size[k] < BOX_LEAST * def->spacing || size[k] > 1e6)
            return error_set(error, "a side of the box must be %d spacings, %.3g m, to 1e6 m, not %g m",
                             BOX_LEAST, BOX_LEAST * def->spacing, size[k]);
        if (def->periodic[k] && size[k] != def->box_size[k])
            return error_set(error, "the box has periodic sides along %c, and keeps its size there",
                             "xyz"[k]);
    }
    return true;
}

/* True if the fluid fits into the box; solids are not counted. */
static bool fits(const WorldDef *after, const WorldInfo *info, Error *error)
{
    double room = 1, fluid = (double)info->count;
    for (int k = 0; k < after->dimensions; k++) {
        room *= after->box_size[k];
        fluid *= after->spacing;
    }
    return fluid <= 0.97 * room || error_set(error, "the fluid has no room in a smaller box");
}

bool box_command_apply(const double size[3], World **world, WorldDef *def, Error *error)
{
    WorldDef after = *def;
    WorldInfo info;
    bool smaller = false;
    if (!check(size, def, error))
        return false;
    for (int k = 0; k < def->dimensions; k++) {
        after.box_size[k] = fmax(size[k], def->box_size[k] - BOX_BITE * def->spacing);
        smaller |= after.box_size[k] < def->box_size[k];
    }
    world_info(*world, &info);
    if ((smaller && !fits(&after, &info, error)) || !world_set_shapes(world, &after, error))
        return false;
    *def = after;
    return true;
}
