// Lists particles by cell: those of a texel of the buckets; then, with `placeless`, the particle itself where it has no place
// there. Transform feedback keeps their order.
#include "sim/fragment/particles.glsl"
#include "sim/fragment/cells.glsl"
uniform usampler2DArray buckets;
uniform sampler2D fields; // of density.frag, behind the same grid
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

// What is above a layer that is not full is of old.
bool in_use(ivec2 bucket, int layer)
{
    for (int below = 0; below < layer; below++)
        if (texelFetch(buckets, ivec3(bucket, below), 0).w == 0u)
            return false;
    return true;
}

void main()
{
    if (placeless == 1) {
        if (of_particle(fields, number[0]).w > 0.5)
            list(uint(number[0] + 1));
        return;
    }
    ivec2 bucket = bucket_of(number[0] / bucket_layers);
    int layer = number[0] % bucket_layers;
    if (!in_use(bucket, layer))
        return;
    uvec4 four = texelFetch(buckets, ivec3(bucket, layer), 0);
    for (int k = 0; k < 4 && four[k] != 0u; k++)
        list(four[k]);
}
