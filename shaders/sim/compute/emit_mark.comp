// Marks points of a layer with room: has_room of sim/cpu/forces.c. Points of a layer are further apart than the limit.
#include "sim/constants.glsl"
#include "sim/in_box.glsl"
#include "sim/walk.glsl"
#include "shaders/sim/flow_block.h"
#ifdef SOLIDS
#include "sim/solids.glsl"
#endif
layout(std430, binding = POSITIONS_BUFFER) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = LAYER_BUFFER) readonly buffer Layer { float candidates[]; }; // x y z per point
layout(std430, binding = MARKS_BUFFER) writeonly buffer Marks { uint mark[]; }; // plus an extra entry, 0, for the total

bool taken = false;

void meet(uint j, vec3 d, float volume)
{
    float least = 0.9 * spacing;
    taken = taken || dot(d, d) < least * least;
}

bool has_room(vec3 x)
{
    ivec3 at = cell_of(x);
    WALK(x, at, meet, meet)
    for (uint j = gridded; j < particle_count(); j++) // particles added since the grid
        meet(j, nearest(x - position[j].xyz), 0.0);
#ifdef SOLIDS
    float half_spacing = 0.5 * spacing;
    for (int k = 0; k < solid_total; k++)
        taken = taken || solid_clearance(k, x, half_spacing) < half_spacing * 0.999;
#endif
    return !taken;
}

void main()
{
    uint k = invocation(), count = candidate_total;
    if (k > count)
        return;
    vec3 x = k < count ? vec3(candidates[3u * k], candidates[3u * k + 1u], candidates[3u * k + 2u]) : vec3(0);
    mark[k] = k < count && in_the_box(x) && has_room(x) ? 1u : 0u;
}
