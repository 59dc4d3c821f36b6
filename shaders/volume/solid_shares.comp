// No particles are in a solid, so the field would end before the surface, and be low along it. Here the field is divided by the
// part of the kernel free of solids, as in Shepard's interpolation (1968): fluid reaches into the solid, level.
#include "volume/volume.glsl"
#include "shaders/volume/solid_shares_block.h"

layout(local_size_x = 64) in;
layout(binding = FIELD_IMAGE, r32f) uniform image3D sums;
layout(std430, binding = SOLID_SHARES_STORAGE) readonly buffer Shares { float share_values[]; };

float node_at(PlacedShare solid, ivec3 node)
{
    return share_values[solid.first + (node.z * solid.nodes.y + node.y) * solid.nodes.x + node.x];
}

float row_at(PlacedShare solid, ivec3 node, float part)
{
    return mix(node_at(solid, node), node_at(solid, ivec3(min(node.x + 1, solid.nodes.x - 1), node.yz)), part);
}

// The part of the kernel around a node's place, between nodes.
float share_at(PlacedShare solid, vec3 at)
{
    ivec3 low = ivec3(at), high = min(low + 1, solid.nodes - 1);
    vec3 part = at - vec3(low);
    vec2 near = vec2(row_at(solid, low, part.x), row_at(solid, ivec3(low.x, high.y, low.z), part.x));
    vec2 far = vec2(row_at(solid, ivec3(low.xy, high.z), part.x), row_at(solid, ivec3(low.x, high.yz), part.x));
    return mix(mix(near.x, near.y, part.y), mix(far.x, far.y, part.y), part.z);
}

// Software drivers only skip loops. Beyond a block, with outermost values of 0, shares are 0.
void main()
{
    int number = int((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x);
    ivec3 cell = shared_first + ivec3(number % shared_cells.x, number / shared_cells.x % shared_cells.y,
                                      number / (shared_cells.x * shared_cells.y));
    bool there = cell.z < shared_first.z + shared_cells.z;
    float sum = there ? imageLoad(sums, cell).x : 0.0, taken = 0.0;
    for (int i = 0, count = sum != 0.0 ? share_count : 0; i < count; i++) {
        vec3 at = (shares[i].from_cells * vec4(vec3(cell) + 0.5, 1.0)).xyz, last = vec3(shares[i].nodes - 1);
        bool within = all(greaterThanEqual(at, vec3(0.0))) && all(lessThanEqual(at, last));
        for (int rounds = within ? 1 : 0; rounds > 0; rounds--)
            taken += share_at(shares[i], at);
    }
    if (taken > 0.0)
        imageStore(sums, cell, vec4(sum / max(1.0 - taken, least_free)));
}
