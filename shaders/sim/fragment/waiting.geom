// Lists the particles left over by a layer of the buckets: the layer's last place holds an earlier particle.
// Transform feedback keeps the order.
#include "sim/fragment/particles.glsl"
#include "sim/fragment/cells.glsl"
uniform usampler2DArray buckets;
uniform int layer;
layout(points) in;
layout(points, max_vertices = 1) out;
in uint candidate[];
out uint waiting;

void main()
{
    vec4 own = of_particle(position, int(candidate[0]) - 1);
    uint last = texelFetch(buckets, ivec3(bucket_of(cell_index(cell_of(own.xyz))), layer), 0).w;
    if (last == 0u || of_particle(position, int(last) - 1).w >= own.w)
        return;
    waiting = candidate[0];
    EmitVertex();
}
