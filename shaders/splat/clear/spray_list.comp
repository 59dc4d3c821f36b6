// Lists the isolated drops, in the particles' order, and writes the drawing command, for render/views/splat/splat_shapes.c. One workgroup does
// all the work.
#define ELLIPSOID 1
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/ball.glsl"
#include "splat/clear/alone.glsl"
#include "shaders/splat/splat_bindings.h"

layout(local_size_x = 256) in;
layout(location = CULL_COUNT_AT) uniform uint count;
layout(location = VERTICES_AT) uniform uint vertices; // vertices per particle
layout(std430, binding = NEAREST_LIST_STORAGE) writeonly buffer List { uint list[]; };
layout(std430, binding = CULL_COMMANDS_STORAGE) writeonly buffer Commands { uint command[8]; }; // as in splat/cull_sum.comp
shared uint part[256];

void main()
{
    uint lane = gl_LocalInvocationID.x, each = (count + 255u) / 256u, sum = 0u;
    uint first = min(lane * each, count), end = min(first + each, count);
    for (uint i = first; i < end; i++)
        sum += uint(is_alone(i));
    part[lane] = sum;
    barrier();
    for (uint reach = 1u; reach < 256u; reach *= 2u) { // Hillis and Steele 1986
        uint before = lane >= reach ? part[lane - reach] : 0u;
        barrier();
        part[lane] += before;
        barrier();
    }
    uint to = part[lane] - sum;
    for (uint i = first; i < end; i++)
        if (is_alone(i))
            list[to++] = i;
    if (lane < 8u)
        command[lane] = lane == 0u ? vertices * part[255] : lane == 1u ? 1u : 0u;
}
