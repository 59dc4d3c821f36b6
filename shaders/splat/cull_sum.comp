// Turns the numbers of kept particles into prefix sums, and writes the drawing commands. One workgroup does all the work.
#include "shaders/splat/splat_bindings.h"
layout(local_size_x = 256) in;
layout(location = CHUNKS_AT) uniform uint chunks;
layout(location = VERTICES_AT) uniform uint vertices; // vertices per particle
layout(std430, binding = CULL_KEPT_STORAGE) buffer Kept { uvec4 kept[]; }; // as in cull_test.comp
layout(std430, binding = CULL_COMMANDS_STORAGE) writeonly buffer Commands { uint command[]; }; // 8 words per list
shared uvec2 part[256];

void main()
{
    uint lane = gl_LocalInvocationID.x, each = (chunks + 255u) / 256u;
    uint first = min(lane * each, chunks), end = min(first + each, chunks);
    uvec2 sum = uvec2(0u);
    for (uint i = first; i < end; i++)
        sum += kept[i].zw;
    part[lane] = sum;
    barrier();
    for (uint reach = 1u; reach < 256u; reach *= 2u) { // Hillis and Steele 1986
        uvec2 before = lane >= reach ? part[lane - reach] : uvec2(0u);
        barrier();
        part[lane] += before;
        barrier();
    }
    uvec2 running = part[lane] - sum;
    for (uint i = first; i < end; i++) {
        uvec2 own = kept[i].zw;
        kept[i].zw = running;
        running += own;
    }
    if (lane < 2u) { // count, instances, first, base vertex, base instance: fits both kinds of indirect drawing
        for (uint word = 0u; word < 8u; word++)
            command[lane * 8u + word] = word == 1u ? 1u : 0u;
        command[lane * 8u] = vertices * part[255][lane];
    }
}
