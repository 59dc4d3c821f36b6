// Light as points, one per texel of straight light, moved to where the smoothed surface refracts the light. A flat surface would
// move all points by the same offset; this offset is subtracted, so that patterns lie in the fluid's shadow, which is cast
// straight. After: Shah, Konttinen and Pattanaik, Caustics mapping: an image-space technique for real-time caustics, 2007.
#include "common/frame.glsl"
#include "shaders/shared/shadow_maps.h"
layout(binding = CAUSTIC_UNIT) uniform sampler2D height_map;
layout(location = REFRACTION_INDEX_AT) uniform float refraction_index;
layout(location = CAUSTIC_HIGHEST_AT) uniform float highest; // above the floor, m
layout(location = 0) flat out vec2 centre; // texels

const float steepest = 1.5, overhang = 0.3, apart = 1.0; // apart: spacings between heights of neighbouring texels

// The height's slope across a texel, from neighbours of the same surface.
float slope_along(ivec2 texel, ivec2 along, float here, float side)
{
    vec2 before = texelFetch(height_map, max(texel - along, ivec2(0)), 0).xy,
         after = texelFetch(height_map, min(texel + along, ivec2(CAUSTIC_TEXELS - 1)), 0).xy;
    bool low = before.y > 0.0 && abs(before.x - here) < apart * particle_spacing,
         high = after.y > 0.0 && abs(after.x - here) < apart * particle_spacing;
    float rise = (high ? after.x : here) - (low ? before.x : here);
    return low || high ? rise / (float(int(low) + int(high)) * side) : 0.0;
}

// The horizontal displacement of light refracted by a surface with this slope, per metre of fall.
vec2 bent(vec2 slope, vec3 to_light)
{
    vec3 normal = normalize(vec3(-slope.x, 1.0, -slope.y)), on = refract(-to_light, normal, 1.0 / refraction_index);
    return on.xz / max(-on.y, 0.1);
}

void main()
{
    ivec2 texel = ivec2(gl_VertexID % CAUSTIC_TEXELS, gl_VertexID / CAUSTIC_TEXELS);
    vec2 side = floor_map_size / float(CAUSTIC_TEXELS);
    vec3 here = texelFetch(height_map, texel, 0).xyz;
    vec3 to_light = mat3(eye_to_world) * light_in_eye;
    vec2 on_floor = vec2(slope_along(texel, ivec2(1, 0), here.x, side.x), slope_along(texel, ivec2(0, 1), here.x, side.y));
    // Heights are stored at floor positions of oblique light; converts to the slope over the surface itself.
    float upright = 1.0 + dot(to_light.xz / to_light.y, on_floor);
    vec2 slope = upright > overhang ? on_floor / upright : vec2(0.0);
    slope *= min(1.0, steepest / max(length(slope), 1e-6));
    // Spray, drops and rims do not refract. Fluid far above its level at rest lets the light out again below.
    float share = (1.0 - smoothstep(0.9, 1.8, sqrt(here.z) / particle_spacing)) * smoothstep(0.5, 0.9, here.y);
    share *= 1.0 - smoothstep(1.0, 1.5, here.x / highest);
    vec2 moved = share * here.x * (bent(slope, to_light) - bent(vec2(0.0), to_light));
    centre = vec2(texel) + 0.5 + (here.y > 0.0 ? moved / side : vec2(0.0));
    gl_Position = vec4(2.0 * centre / float(CAUSTIC_TEXELS) - 1.0, 0.0, 1.0);
    gl_PointSize = 4.0;
}
