// Particles seen from the light: squares with the disc's area at the depth of the centre, rounded by blur and bilinear filter.
// For such small squares a compute shader is cheaper than a rasteriser (Schütz, Kerbl, Wimmer: Rendering point clouds with
// compute shaders, 2021): on a software driver a fifth of the time.
#include "common/frame.glsl"
#include "common/particles.glsl"
#include "common/ball.glsl"
#include "common/scattered.glsl"
#include "common/nan.glsl"
#include "shaders/shared/shadow_maps.h"
#ifdef VEILED
#include "common/particle_veils.glsl"
#endif

layout(local_size_x = 64) in;
// `lit`, four texels per fetch. Stale values are only too far, and cost an atomic without effect.
layout(binding = CAST_UNIT) uniform usamplerBuffer lit_rows;
layout(location = CASTERS_AT) uniform uint casters;                  // number of particles
layout(std430, binding = CAST_STORAGE) buffer Lit { uint lit[]; }; // bits of depths, ordered like the depths

// A bit for each of 8 x 4 texels from `corner` on: set if within `low` to `end` and farther than `depth`.
uint behind_in(uvec2 corner, uvec2 low, uvec2 end, uint depth)
{
    uint bits = 0u, within = 255u << (max(low.x, corner.x) - corner.x) & 255u >> (8u - min(end.x - corner.x, 8u));
    for (uint y = corner.y; y < min(corner.y + 4u, end.y); y++)
        for (uint x = 0u; x < 2u && corner.x + 4u * x < end.x; x++) {
            uint texel = (y * SHADOW_MAP_TEXELS + corner.x) / 4u + x;
            uvec4 behind = uvec4(lessThan(texelFetch(lit_rows, int(texel)), uvec4(depth))) << uvec4(0u, 1u, 2u, 3u);
            bits |= ((behind.x | behind.y | behind.z | behind.w) << 4u * x & within) << 8u * (y - corner.y);
        }
    return bits;
}

// A software driver skips loops, but not code in an `if`: hence bits, and atomics in a loop over the bits.
void main()
{
    uint index = scattered(casters);
    if (index >= casters)
        return;
#ifdef VEILED
    if (veil[index].y >= veil[index].x) // particles cast shadows with a probability of their opacity
        return;
#endif
    Ball ball = ball_of(index);
    vec3 at = (box_to_light * vec4(ball.centre, 1.0)).xyz;
    if (is_nan(vec4(at, 0.0)) || any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0))))
        return;
    const float side = float(SHADOW_MAP_TEXELS); // the map is light_depth wide
    float reach = 0.5 * max(1.77245 * shadow_radius * (ball.radius / particle_radius) / light_depth * side, 1.0);
    uvec2 low = uvec2(max(ceil(at.xy * side - reach - 0.5), 0.0)); // texels with centres inside
    uvec2 end = uvec2(min(ceil(at.xy * side + reach - 0.5), side));
    uint depth = floatBitsToUint(at.z) & 0x7fffffffu; // no -0
    for (uint y = low.y; y < end.y; y += 4u)
        for (uint x = low.x & ~3u; x < end.x; x += 8u)
            for (uint bits = behind_in(uvec2(x, y), low, end, depth); bits != 0u; bits &= bits - 1u) {
                uint at_bit = uint(findLSB(bits));
                atomicMax(lit[(y + at_bit / 8u) * SHADOW_MAP_TEXELS + x + at_bit % 8u], depth);
            }
}
