// Which points of a layer have room: has_room of sim/cpu/flow.c. Points of one layer are further apart than that.
#include "sim/constants.glsl"
#include "sim/in_box.glsl"
#include "sim/rows.glsl"
#include "sim/flow.glsl"
#ifdef SOLIDS
#include "sim/solids.glsl"
#define BOUNDARY_ACCESS readonly
#include "sim/boundary.glsl"
#endif
layout(std430, binding = 0) readonly buffer Positions { vec4 position[]; };
layout(std430, binding = 1) readonly buffer Layer { float candidates[]; }; // x y z of each
layout(std430, binding = 3) writeonly buffer Marks { uint mark[]; }; // one more, 0, for the sum of all

bool is_near(vec3 x, vec3 other)
{
    float least = 0.9 * kernel.w;
    vec3 d = x - other;
    return dot(d, d) < least * least;
}

bool has_room(vec3 x)
{
    ivec3 at = cell_of(x);
    for (int row = FIRST_ROW; row < LAST_ROW; row++) {
        uvec2 range = row_of(at, row);
        vec3 seen_from = row_seen(x, at, row);
        for (uint j = range.x; j < range.y; j++)
            if (is_near(seen_from, position[j].xyz))
                return false;
#ifdef SOLIDS
        range = boundary_row_of(at, row);
        for (uint j = range.x; j < range.y; j++)
            if (is_near(seen_from, boundary_position[j].xyz))
                return false;
#endif
    }
    for (uint j = uint(flow_counts.w); j < particle_count(); j++) // those that came since
#ifdef PERIODIC
        if (is_near(nearest(x - position[j].xyz), vec3(0)))
#else
        if (is_near(x, position[j].xyz))
#endif
            return false;
#ifdef SOLIDS
    float half_spacing = 0.5 * kernel.w;
    for (int k = 0; k < solid_counts.x; k++)
        if (solid_clearance(k, x, half_spacing) < half_spacing * 0.999)
            return false;
#endif
    return true;
}

void main()
{
    uint k = invocation(), count = uint(flow_counts.z);
    if (k > count)
        return;
    vec3 x = k < count ? vec3(candidates[3u * k], candidates[3u * k + 1u], candidates[3u * k + 2u]) : vec3(0);
    mark[k] = k < count && in_the_box(x) && has_room(x) ? 1u : 0u;
}
