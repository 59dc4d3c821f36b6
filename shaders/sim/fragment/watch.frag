// Findings of the step over all particles: each texel reduces 8 x 8 texels of the texture before, down to a single
// texel. Bits of non-negative floats have the order of the floats, and the bits of NaN are above all.
#include "sim/fragment/particles.glsl"
layout(location = 0) out uvec4 found; // greatest speed^2, acceleration^2, n / n0; lost: particles without a place
layout(location = 1) out uint held_sum;

#if defined FIRST
uniform sampler2D acceleration, fields;
uniform usampler2D held;
uniform vec3 gravity;

uvec4 found_at(ivec2 at)
{
    if ((at.y << particle_bits) + at.x >= particle_count)
        return uvec4(0);
    vec3 v = texelFetch(velocity, at, 0).xyz, a = texelFetch(acceleration, at, 0).xyz + gravity;
    vec4 own = texelFetch(fields, at, 0);
    return uvec4(floatBitsToUint(abs(dot(v, v))), floatBitsToUint(abs(dot(a, a))),
                 floatBitsToUint(abs(1.0 / (own.x * rest_number_density))), uint(own.w));
}
#else
uniform usampler2D finer, held;

uvec4 found_at(ivec2 at) { return texelFetch(finer, at, 0); }
#endif

void main()
{
    ivec2 first = 8 * ivec2(gl_FragCoord.xy), end = min(first + 8, textureSize(held, 0));
    found = uvec4(0);
    held_sum = 0u;
    for (int y = first.y; y < end.y; y++)
        for (int x = first.x; x < end.x; x++) {
            uvec4 one = found_at(ivec2(x, y));
            found = uvec4(max(found.xyz, one.xyz), found.w + one.w);
            held_sum += texelFetch(held, ivec2(x, y), 0).x;
        }
}
