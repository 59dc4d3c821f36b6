// The field and its slope along the ray, per radius, at four positions behind the depth in the map. With SINGLE the field and its
// first three derivatives at that depth.
#include "common/frame.glsl"
#include "common/sphere.glsl"
#include "splat/splat.glsl"
#include "splat/splat_at.glsl"
#include "splat/splat_level.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = NEAREST_UNIT) uniform sampler2D start_map;
layout(location = APART_AT) uniform float apart; // radii between samples
layout(early_fragment_tests) in;
layout(location = 0) out vec4 value_sum;
#ifndef SINGLE
layout(location = 1) out vec4 slope_sum;
#endif

void main()
{
    SplatChord chord = splat_chord(splat_at(), scale);
    if (!splat_adds(chord))
        discard;
    float first = (texelFetch(start_map, ivec2(gl_FragCoord.xy), 0).x - chord.middle) / particle_radius;
#ifdef SINGLE
    float a = chord.inside2 - chord.length2 * first * first, b = -2.0 * chord.length2 * first;
    if (a <= 0.0)
        discard;
    value_sum = vec4(a * a * a, 3.0 * a * a * b, 6.0 * a * (b * b - a * chord.length2), 6.0 * b * (b * b - 6.0 * a * chord.length2));
#else
    vec4 s = first + apart * vec4(1.0, 2.0, 3.0, 4.0), a = max(chord.inside2 - chord.length2 * s * s, 0.0);
    value_sum = a * a * a;
    slope_sum = -6.0 * chord.length2 * s * a * a;
#endif
}
