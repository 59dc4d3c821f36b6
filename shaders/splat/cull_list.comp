// Writes the indices of the kept particles, in order: blending gives the same bits as without culling.
#include "shaders/splat/splat_bindings.h"
layout(local_size_x = 64) in;
layout(location = CHUNKS_AT) uniform uint chunks;
layout(std430, binding = CULL_KEPT_STORAGE) readonly buffer Kept { uvec4 kept[]; }; // bits of two lists; numbers before
layout(std430, binding = NEAREST_LIST_STORAGE) writeonly buffer Nearest { uint nearest_list[]; };
layout(std430, binding = BLEND_LIST_STORAGE) writeonly buffer Blended { uint blend_list[]; };

void main()
{
    uint chunk = gl_GlobalInvocationID.x;
    if (chunk >= chunks)
        return;
    uvec4 own = kept[chunk];
    for (uint bits = own.x; bits != 0u; bits &= bits - 1u)
        nearest_list[own.z++] = chunk * 32u + uint(findLSB(bits));
    for (uint bits = own.y; bits != 0u; bits &= bits - 1u)
        blend_list[own.w++] = chunk * 32u + uint(findLSB(bits));
}
