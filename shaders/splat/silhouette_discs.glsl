// Outlines by the discs of the foremost spheres around a pixel, for shaders/splat/silhouette_blend.frag.
#include "shaders/splat/splat_bindings.h"
layout(binding = COLOR_SUM_UNIT) uniform sampler2D color_map;   // alpha: x of the vector from the pixel's ray to the outline of the foremost sphere
layout(binding = NORMAL_SUM_UNIT) uniform sampler2D normal_map; // alpha: y of this vector; in radii

const int SAMPLES = 16;

// Centre, relative to the pixel's centre, and radius of the foremost sphere's disc, in pixels.
vec3 disc_of(ivec2 pixel, float depth)
{
    float radius = 0.5 * picture_size.y / view_tangent.y * particle_radius / depth;
    vec2 rim = radius * vec2(texelFetch(color_map, pixel, 0).a, texelFetch(normal_map, pixel, 0).a);
    float length2 = dot(rim, rim);
    return length2 > 0.0 ? vec3(rim * (1.0 - radius * inversesqrt(length2)), radius) : vec3(0.0, 0.0, 0.75);
}

// Bits of the pixel's samples inside a disc.
uint samples_in(vec3 disc)
{
    uint bits = 0u;
    for (int s = 0; s < SAMPLES; s++) {
        vec2 apart = (vec2(s, (7 * s + 3) % SAMPLES) + 0.5) / float(SAMPLES) - 0.5 - disc.xy;
        bits |= dot(apart, apart) < disc.z * disc.z ? 1u << s : 0u;
    }
    return bits;
}

// Contents of a pixel's samples: colours of nearer spheres, the pixel's own surface, or the background.
struct Shown {
    vec3 nearer; // sum over samples
    uint nearer_bits, own_bits;
};

Shown show(ivec2 pixel, float depth)
{
    Shown shown = Shown(vec3(0.0), 0u, 0u);
    for (int i = 0; i < 9; i++) {
        ivec2 offset = ivec2(i % 3, i / 3) - 1;
        Seen seen = seen_at(pixel + offset);
        uint bits = samples_in(disc_of(pixel + offset, seen.depth) + vec3(offset, 0.0));
        if (!seen.fluid || seen.depth > depth + least)
            continue;
        bool nearer = seen.depth < depth - least;
        shown.nearer += nearer ? float(bitCount(bits & ~shown.nearer_bits)) * color_of(pixel + offset) : vec3(0.0);
        shown.nearer_bits |= nearer ? bits : 0u;
        shown.own_bits |= nearer ? 0u : bits;
    }
    return shown;
}

void add_behind(inout vec4 sum, float side, ivec2 pixel, float depth)
{
    if (side > 0.75 && seen_at(pixel).depth > depth + least)
        sum += vec4(color_of(pixel), 1.0);
}

// `sides`: edges on the right, above, on the left, below.
vec3 mixed_by_discs(ivec2 pixel, vec3 own, vec4 sides)
{
    Seen here = seen_at(pixel);
    vec4 behind = vec4(0.0);
    add_behind(behind, sides.x, pixel + ivec2(1, 0), here.depth);
    add_behind(behind, sides.y, pixel + ivec2(0, 1), here.depth);
    add_behind(behind, sides.z, pixel - ivec2(1, 0), here.depth);
    add_behind(behind, sides.w, pixel - ivec2(0, 1), here.depth);
    vec3 far = here.fluid && behind.w > 0.0 ? behind.rgb / behind.w : own;
    Shown shown = show(pixel, here.depth);
    float own_count = float(bitCount(shown.own_bits & ~shown.nearer_bits));
    float rest = float(SAMPLES - bitCount(shown.own_bits | shown.nearer_bits));
    return (shown.nearer + own_count * own + rest * far) / float(SAMPLES);
}
