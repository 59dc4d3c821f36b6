// The next sphere that starts behind the searched range, by minimum blending.
#include "common/frame.glsl"
#include "common/sphere.glsl"
#include "splat/splat.glsl"
#include "splat/splat_at.glsl"
#include "splat/splat_level.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = MARCH_UNIT) uniform sampler2D march_map;
layout(early_fragment_tests) in;
layout(location = 0) out float nearest;

void main()
{
    SplatChord chord = splat_chord(splat_at(), scale);
    float entry = splat_entry(chord);
    nearest = splat_adds(chord) && entry > texelFetch(march_map, ivec2(gl_FragCoord.xy), 0).x ? entry : 1e30;
}
