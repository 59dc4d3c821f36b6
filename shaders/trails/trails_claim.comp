// Resolves conflicts if ids grow without limit and two particles want the same trail: the older particle, with the smaller id,
// wins.
#include "shaders/trails/trails_slot.glsl"
layout(local_size_x = 64) in;

layout(std430, binding = TRAIL_IDS_STORAGE) readonly buffer Ids { uint ids[]; };
layout(std430, binding = TRAIL_CLAIMS_STORAGE) buffer Claims { uint claims[]; };
layout(location = TRAIL_COUNT_AT) uniform uint count;
layout(location = TRAIL_ID_STRIDE_AT) uniform uint id_stride;

void main()
{
    uint index = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
    if (index >= count)
        return;
    uint id = ids[index * id_stride];
    int slot = slot_of(id);
    if (slot >= 0)
        atomicMin(claims[slot], id);
}
