// Particles seen from the light: discs at the depth of the centre, in texels with centres inside. For such small discs a
// compute shader is cheaper than a rasteriser (Schütz, Kerbl, Wimmer: Rendering point clouds with
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

// A particle in the map, in texels.
struct Disc {
    vec2 at;
    float radius;
};

// The texels of row `y` with centres inside: first and behind the last. A disc between the
// centres has the texel around its middle.
uvec2 row_of(Disc disc, uint y)
{
    float away = abs(float(y) + 0.5 - disc.at.y), half_row = sqrt(max(disc.radius * disc.radius - away * away, 0.0));
    half_row = away <= 0.5 ? max(half_row, 0.5) : half_row;
    return uvec2(clamp(ceil(disc.at.x + vec2(-half_row, half_row) - 0.5), 0.0, float(SHADOW_MAP_TEXELS)));
}

// A bit for each of 8 x 4 texels from `corner` on: set if within the disc and farther than `depth`.
uint behind_in(uvec2 corner, Disc disc, uint end_row, uint depth)
{
    uint bits = 0u;
    for (uint y = corner.y; y < min(corner.y + 4u, end_row); y++) {
        uvec2 row = clamp(row_of(disc, y), uvec2(corner.x), uvec2(corner.x + 8u)) - corner.x;
        uint within = 255u << row.x & ~(65535u << row.y) & 255u;
        for (uint x = 0u; x < 2u && 4u * x < row.y; x++) {
            uint texel = (y * SHADOW_MAP_TEXELS + corner.x) / 4u + x;
            uvec4 behind = uvec4(lessThan(texelFetch(lit_rows, int(texel)), uvec4(depth))) << uvec4(0u, 1u, 2u, 3u);
            bits |= ((behind.x | behind.y | behind.z | behind.w) << 4u * x & within) << 8u * (y - corner.y);
        }
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
    Disc disc = Disc(at.xy * side, shadow_radius * (ball.radius / particle_radius) / light_depth * side);
    float reach = max(disc.radius, 0.5);
    uvec2 low = uvec2(max(ceil(disc.at - reach - 0.5), 0.0)); // texels with centres inside
    uvec2 end = uvec2(min(ceil(disc.at + reach - 0.5), side));
    uint depth = floatBitsToUint(at.z) & 0x7fffffffu; // no -0
    for (uint y = low.y; y < end.y; y += 4u)
        for (uint x = low.x & ~3u; x < end.x; x += 8u)
            for (uint bits = behind_in(uvec2(x, y), disc, end.y, depth); bits != 0u; bits &= bits - 1u) {
                uint at_bit = uint(findLSB(bits));
                atomicMax(lit[(y + at_bit / 8u) * SHADOW_MAP_TEXELS + x + at_bit % 8u], depth);
            }
}
