// Numbers become sums of those before. One workgroup does it all.
#include "volume/volume.glsl"
#include "shaders/volume/volume_bindings.h"

layout(local_size_x = 256) in;
layout(std430, binding = LIST_STARTS_STORAGE) buffer ListStarts { uint list_starts[]; };
shared uint part[256];

void main()
{
    uint count = uint(list_size.x * list_size.y * list_size.z), lane = gl_LocalInvocationID.x, each = (count + 255u) / 256u;
    uint first = min(lane * each, count) + 1u, end = min((lane + 1u) * each, count) + 1u, sum = 0u;
    for (uint i = first; i < end; i++)
        sum += list_starts[i];
    part[lane] = sum;
    barrier();
    for (uint reach = 1u; reach < 256u; reach *= 2u) { // Hillis and Steele 1986
        uint before = lane >= reach ? part[lane - reach] : 0u;
        barrier();
        part[lane] += before;
        barrier();
    }
    uint running = part[lane] - sum;
    for (uint i = first; i < end; i++) {
        uint own = list_starts[i];
        list_starts[i] = running;
        running += own;
    }
}
