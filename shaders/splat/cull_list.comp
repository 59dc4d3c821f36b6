// Writes the indices of the kept particles, in order: blending gives the same bits as without culling. Also writes the drawing
// commands.
#include "splat/cull_kept.glsl"
#include "shaders/splat/splat_bindings.h"
layout(local_size_x = 64) in;
layout(location = CHUNKS_AT) uniform uint chunks;
layout(location = VERTICES_AT) uniform uint vertices; // vertices per particle
layout(std430, binding = CULL_KEPT_STORAGE) readonly buffer Kept { uint kept[]; };
layout(std430, binding = NEAREST_LIST_STORAGE) writeonly buffer Nearest { uint nearest_list[]; };
layout(std430, binding = BLEND_LIST_STORAGE) writeonly buffer Blended { uint blend_list[]; };
layout(std430, binding = CULL_COMMANDS_STORAGE) writeonly buffer Commands { uint command[]; }; // 8 words per list

// Count, instances, first, base vertex, base instance: fits both kinds of indirect drawing.
void write_command(uint list, uint total)
{
    for (uint word = 0u; word < 8u; word++)
        command[list * 8u + word] = word == 0u ? vertices * total : word == 1u ? 1u : 0u;
}

void main()
{
    uint chunk = gl_GlobalInvocationID.x;
    if (chunk >= chunks)
        return;
    uint nearest = kept[KEPT_NUMBER(1u)]; // in all
    uint to_nearest = kept[KEPT_NUMBER(0u) + chunk], to_blend = kept[KEPT_NUMBER(1u) + chunk] - nearest;
    for (uint bits = kept[KEPT_BITS(0u) + chunk]; bits != 0u; bits &= bits - 1u)
        nearest_list[to_nearest++] = chunk * 32u + uint(findLSB(bits));
    for (uint bits = kept[KEPT_BITS(1u) + chunk]; bits != 0u; bits &= bits - 1u)
        blend_list[to_blend++] = chunk * 32u + uint(findLSB(bits));
    if (chunk > 0u)
        return;
    write_command(0u, nearest);
    write_command(1u, kept[KEPT_NUMBER(2u)] - nearest);
}
