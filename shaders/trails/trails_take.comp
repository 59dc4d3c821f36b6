// Fills the present state's column: position, scalar and owner of each chosen particle.
#include "common/particles.glsl"
#include "common/particle_shown.glsl"
#include "common/nan.glsl"
#include "shaders/trails/trails_slot.glsl"
layout(local_size_x = 64) in;

layout(std430, binding = TRAIL_IDS_STORAGE) readonly buffer Ids { uint ids[]; };
layout(std430, binding = TRAIL_PLACES_STORAGE) buffer Places { vec4 places[]; };
layout(std430, binding = TRAIL_OWNERS_STORAGE) buffer Owners { uint owners[]; };
layout(std430, binding = TRAIL_SEEN_STORAGE) buffer Seen { uint seen[]; };
layout(std430, binding = TRAIL_CLAIMS_STORAGE) readonly buffer Claims { uint claims[]; };
layout(location = TRAIL_COUNT_AT) uniform uint count;
layout(location = TRAIL_ID_STRIDE_AT) uniform uint id_stride;
layout(location = TRAIL_COLUMN_AT) uniform uint column;  // first element of the column
layout(location = TRAIL_BEFORE_AT) uniform uint before;  // previous column, or TRAIL_NO_COLUMN
layout(location = TRAIL_CLAIMS_AT) uniform uint claimed; // 0: no two particles want the same trail
layout(location = TRAIL_LEAST_AT) uniform vec3 least; // corner of the region
layout(location = TRAIL_GREATEST_AT) uniform vec3 greatest;
layout(location = TRAIL_PLANE_AT) uniform vec4 plane; // normal, and the normal's dot product with the point

// An owner is 2 (id + 1), plus 1 if the trail is visible; 0: no owner.
uint chosen_at_first(vec3 at)
{
    bool anywhere = least == greatest, inside = all(greaterThanEqual(at, least)) && all(lessThanEqual(at, greatest));
    return plane.xyz == vec3(0.0) && (anywhere || inside) ? 1u : 0u;
}

bool crosses(uint slot, uint owner, vec3 at)
{
    if (before == TRAIL_NO_COLUMN || plane.xyz == vec3(0.0) || owners[before + slot] >> 1u != owner >> 1u)
        return false;
    return dot(plane.xyz, places[before + slot].xyz) < plane.w != dot(plane.xyz, at) < plane.w;
}

void main()
{
    uint index = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    if (index >= count)
        return;
    uint id = ids[index * id_stride], owner = 2u * (id + 1u);
    int slot = slot_of(id);
    if (slot < 0 || (claimed != 0u && claims[slot] != id))
        return;
    vec3 at = particle_position(index);
    if (is_nan(vec4(at, 0.0)) || any(greaterThan(abs(at), vec3(1e30))))
        return;
    if (seen[slot] >> 1u != owner >> 1u)
        seen[slot] = owner + chosen_at_first(at);
    else if (crosses(uint(slot), owner, at))
        seen[slot] = owner + 1u;
    places[column + uint(slot)] = vec4(at, particle_shown(index));
    owners[column + uint(slot)] = seen[slot];
}
