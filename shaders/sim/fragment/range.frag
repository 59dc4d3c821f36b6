// Least and greatest of a scalar, as bits in their order: each texel of 8 x 8 of the texture before, like watch.frag.
#include "sim/fragment/particles.glsl"
#include "common/in_order.glsl"
uniform usampler2D finer;
layout(location = 0) out uvec4 range;

uvec2 range_at(ivec2 at)
{
#ifdef FIRST
    if ((at.y << particle_bits) + at.x >= particle_count)
        return uvec2(0xffffffffu, 0u);
    return uvec2(in_order(uintBitsToFloat(texelFetch(finer, at, 0).x)));
#else
    return texelFetch(finer, at, 0).xy;
#endif
}

void main()
{
    ivec2 first = 8 * ivec2(gl_FragCoord.xy), end = min(first + 8, textureSize(finer, 0));
    range = uvec4(0xffffffffu, 0u, 0u, 0u);
    for (int y = first.y; y < end.y; y++)
        for (int x = first.x; x < end.x; x++) {
            uvec2 one = range_at(ivec2(x, y));
            range.xy = uvec2(min(range.x, one.x), max(range.y, one.y));
        }
}
