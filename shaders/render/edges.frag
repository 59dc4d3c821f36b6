// Plain lines, or the edges of glass panes: a ground bevel that reflects the sky on the side of the light. On the other side the
// view goes along the glass, green from iron. COARSE: drawn over an enlarged coarse picture, tested against the coarse depth.
#include "common/frame.glsl"
#include "common/environment.glsl"
#include "common/encoded.glsl"

layout(location = 0) noperspective in float across;
layout(location = 1) in vec3 place;       // in the eye's frame
layout(location = 2) flat in vec3 normal; // normal of the bevel, towards the eye
layout(location = HALF_WIDTH_AT) uniform float half_width;
layout(location = EDGES_BEHIND_AT) uniform uint behind; // 1: seen through the fluid, where a ground edge is dull
layout(location = 0) out vec4 color;

const vec3 along_glass = vec3(0.09, 0.21, 0.20);

vec4 glass_edge(float cover)
{
    vec3 view = normalize(place), mirror = reflect(view, normal);
    float glint = max(dot(mirror, light_in_eye), 0.0), side = clamp(0.5 + 0.5 * across, 0.0, 1.0);
    glint *= glint, glint *= glint, glint *= glint; // a ground edge is not perfectly smooth
    vec3 mirrored = environment_light((eye_to_world * vec4(place, 1.0)).xyz, mat3(eye_to_world) * mirror);
    vec3 along = along_glass * (0.5 + 0.5 * background), bright = mirrored * 1.1 + 2.5 * glint * light_color;
    return behind != 0u ? vec4(along, 0.5 * cover) : vec4(mix(along, bright, side), cover * mix(0.62, 0.8, side));
}

#ifdef COARSE
layout(binding = COARSE_DEPTH_UNIT) uniform sampler2D coarse_depth;

// The weighted fraction of the four texels around the pixel that are not nearer.
float before()
{
    vec2 at = gl_FragCoord.xy * pixel_size, weight = fract(at * vec2(textureSize(coarse_depth, 0)) - 0.5);
    vec4 behind = step(textureGather(coarse_depth, at), vec4(gl_FragCoord.z));
    return mix(mix(behind.w, behind.z, weight.x), mix(behind.x, behind.y, weight.x), weight.y);
}
#endif

void main()
{
    float cover = clamp(half_width + 0.5 - abs(across), 0.0, 1.0);
#ifdef COARSE
    cover *= before();
#endif
    color = glass != 0u ? glass_edge(cover) : vec4(edge_color.rgb, edge_color.a * cover);
#ifdef COARSE
    color.rgb = encoded(max(color.rgb, 0.0));
#endif
}
