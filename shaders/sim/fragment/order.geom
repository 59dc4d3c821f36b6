// Lists particles by cell: the particles of a texel of the buckets; then, with `placeless`, particles without a place
// in the buckets. Transform feedback keeps the order.
#include "sim/fragment/particles.glsl"
#include "sim/fragment/cells.glsl"
uniform usampler2DArray buckets;
uniform sampler2D fields; // of density.frag, after the same grid
uniform int placeless;
layout(points) in;
layout(points, max_vertices = 4) out;
in int number[];
out uint waiting;

void list(uint entry)
{
    waiting = entry;
    EmitVertex();
}

void main()
{
    if (placeless == 1) {
        if (of_particle(fields, number[0]).w > 0.5)
            list(uint(number[0] + 1));
        return;
    }
    ivec2 bucket = bucket_of(number[0] / bucket_layers);
    uvec4 four = texelFetch(buckets, ivec3(bucket, number[0] % bucket_layers), 0);
    for (int k = 0; k < 4; k++) {
        uint entry = place_of(four, k);
        if (entry == 0u)
            break;
        list(entry);
    }
}
