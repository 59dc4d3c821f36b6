// Plain lines, or the edges of panes of glass: ground to a bevel that mirrors the sky on the side of the light, and through which one
// looks along the glass, green by its iron, on the other.
#include "common/frame.glsl"
#include "common/environment.glsl"

layout(location = 0) noperspective in float across;
layout(location = 1) in vec3 place;       // in the eye's frame
layout(location = 2) flat in vec3 normal; // of the bevel, towards the eye
layout(location = HALF_WIDTH_AT) uniform float half_width;
layout(location = 0) out vec4 color;

const vec3 along_glass = vec3(0.09, 0.21, 0.20);

vec4 glass_edge(float cover)
{
    vec3 view = normalize(place), mirror = reflect(view, normal);
    float glint = max(dot(mirror, light_in_eye), 0.0), side = clamp(0.5 + 0.5 * across, 0.0, 1.0);
    glint *= glint, glint *= glint, glint *= glint; // a ground edge is not quite smooth
    vec3 sky = environment_light((eye_to_world * vec4(place, 1.0)).xyz, mat3(eye_to_world) * mirror);
    vec3 bright = sky * 1.1 + 2.5 * glint * light_color;
    return vec4(mix(along_glass * (0.5 + 0.5 * background), bright, side), cover * mix(0.62, 0.8, side));
}

void main()
{
    float cover = clamp(half_width + 0.5 - abs(across), 0.0, 1.0);
    color = glass != 0u ? glass_edge(cover) : vec4(edge_color.rgb, edge_color.a * cover);
}
