// Plotted sums of a state: each texel sums 8 x 8 texels of the texture before, down to a single texel, like
// watch.frag. Floats as bits, since the targets are shared with the watch.
#include "sim/fragment/particles.glsl"
#include "sim/gauge.glsl"
layout(location = 0) out uvec4 found; // sums: see gauge.glsl
layout(location = 1) out uint greatest;

#if defined FIRST
uniform sampler2D fields;
uniform vec3 gravity;
uniform float c2;

void add(ivec2 at, inout vec4 sum, inout float most)
{
    if ((at.y << particle_bits) + at.x >= particle_count)
        return;
    vec4 x = texelFetch(position, at, 0);
    float compression = stiffness_scale * (1.0 / (texelFetch(fields, at, 0).x * rest_number_density) - 1.0);
    vec4 v = texelFetch(velocity, at, 0);
    sum += gauge_of(fluid_of(v.w).mass, compression, x.xyz, v.xyz, gravity, c2);
    most = max(most, compression);
}

ivec2 size() { return textureSize(position, 0); }
#else
uniform usampler2D finer, held;

void add(ivec2 at, inout vec4 sum, inout float most)
{
    sum += uintBitsToFloat(texelFetch(finer, at, 0));
    most = max(most, uintBitsToFloat(texelFetch(held, at, 0).x));
}

ivec2 size() { return textureSize(finer, 0); }
#endif

void main()
{
    ivec2 first = 8 * ivec2(gl_FragCoord.xy), end = min(first + 8, size());
    vec4 sum = vec4(0.0);
    float most = 0.0;
    for (int y = first.y; y < end.y; y++)
        for (int x = first.x; x < end.x; x++)
            add(ivec2(x, y), sum, most);
    found = floatBitsToUint(sum);
    greatest = floatBitsToUint(most);
}
