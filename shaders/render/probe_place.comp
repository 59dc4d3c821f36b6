// The positions asked for: given, or found from the picture's depth at a pixel.
#include "common/frame.glsl"
#include "render/probe.glsl"
layout(local_size_x = PROBES_MAX) in;
layout(location = PROBE_COUNT_AT) uniform uint probe_count;
layout(location = PROBE_ASKED_AT) uniform vec4 asked[PROBES_MAX]; // x y z in the box's frame, 0; or column, row from below, -, 1
layout(binding = PROBE_DEPTH_UNIT) uniform sampler2D depth_map;

vec4 seen_at(ivec2 pixel)
{
    float depth = texelFetch(depth_map, pixel, 0).x;
    if (depth <= 0.0)
        return vec4(0.0);
    vec3 at = near_plane / depth * ray_of_ndc(ndc_of_pixel(vec2(pixel) + 0.5));
    return vec4((inverse(box_to_eye) * vec4(at, 1.0)).xyz, 1.0);
}

void main()
{
    uint own = gl_LocalInvocationID.x;
    if (own >= probe_count)
        return;
    vec4 said = asked[own];
    answers[own].place = said.w > 0.0 ? seen_at(ivec2(said.xy)) : vec4(said.xyz, 1.0);
}
