// Makes lists of neighbours before particles move. Without lists each pass walks through cells.
#define LISTS_FIRST
#include "sim/constants.glsl"
#include "shaders/sim/pbf/pbf_block.h"
#include "sim/walk.glsl"
#define NO_MEETING(j, d, volume)

void make_list(uint i, vec3 x)
{
#ifdef LISTS
    ivec3 at = cell_of(x);
    WALK_LISTED(i, x, at, NO_MEETING)
#endif
}
