// Particles as the light sees them: squares of the disc's area at the depth of the centre, which the blur and the bilinear texel round
// off. So small they are cheaper written by hand than set up by a rasteriser (Schütz, Kerbl, Wimmer: Rendering point clouds with
// compute shaders, 2021): on a software driver a fifth of the time.
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/ball.glsl"
#include "common/scattered.glsl"
#include "common/nan.glsl"
#include "shaders/shared/shadow_maps.h"

layout(local_size_x = 64) in;
// The same as `lit`, four in a row at once. What is read late is only too far, and costs an atomic that changes nothing.
layout(binding = CAST_UNIT) uniform usamplerBuffer lit_rows;
layout(location = CASTERS_AT) uniform uint casters;                  // how many
layout(std430, binding = CAST_STORAGE) buffer Lit { uint lit[]; }; // bits of a depth, which are ordered as it is

void main()
{
    uint index = scattered(casters);
    if (index >= casters)
        return;
    Ball ball = ball_of(index);
    vec3 at = (box_to_light * vec4(ball.centre, 1.0)).xyz;
    if (is_nan(vec4(at, 0.0)) || any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0))))
        return;
    const float side = float(SHADOW_MAP_TEXELS); // the map is light_depth wide
    float reach = 0.5 * max(1.77245 * shadow_radius * (ball.radius / particle_radius) / light_depth * side, 1.0);
    uvec2 low = uvec2(max(ceil(at.xy * side - reach - 0.5), 0.0)); // texels whose centres are within
    uvec2 end = uvec2(min(ceil(at.xy * side + reach - 0.5), side));
    uint depth = floatBitsToUint(at.z) & 0x7fffffffu; // no -0
    for (uint y = low.y; y < end.y; y++)
        for (uint x = low.x & ~3u; x < end.x; x += 4u) {
            uint first = y * SHADOW_MAP_TEXELS + x;
            bvec4 behind = lessThan(texelFetch(lit_rows, int(first / 4u)), uvec4(depth));
            if (any(behind))
                for (uint i = 0u; i < 4u; i++)
                    if (behind[i] && x + i >= low.x && x + i < end.x)
                        atomicMax(lit[first + i], depth);
        }
}
