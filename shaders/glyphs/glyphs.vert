// Four vertices per arrow: the bounding rectangle on the screen.
#include "common/frame.glsl"
#include "shaders/glyphs/glyphs_bindings.h"

struct Arrow {
    vec4 foot, vector;
};
layout(std430, binding = GLYPH_ARROWS_STORAGE) readonly buffer Arrows { Arrow arrows[]; };
layout(location = GLYPH_SCALE_AT) uniform float scale; // m per unit of the vector
layout(location = GLYPH_SIZE_AT) uniform vec3 size;    // length and radius of the tip; radius of the shaft, m
layout(location = GLYPH_LIFT_AT) uniform float lift;   // towards z, m
layout(location = 0) flat out vec3 foot; // in the eye's frame
layout(location = 1) flat out vec4 axis; // unit vector, length
layout(location = 2) flat out vec3 own;  // size of this arrow: short arrows are thinner in proportion
layout(location = 3) flat out float value;

void main()
{
    Arrow arrow = arrows[uint(gl_VertexID) >> 2];
    vec3 way = mat3(box_to_eye) * (arrow.vector.xyz * scale);
    float long_is = length(way);
    foot = (box_to_eye * vec4(arrow.foot.xyz + vec3(0.0, 0.0, lift), 1.0)).xyz;
    axis = vec4(way / max(long_is, 1e-30), long_is);
    own = size * min(long_is / (1.5 * size.x), 1.0);
    float pixel = -foot.z * view_tangent.y * 2.0 * pixel_size.y; // m
    own.yz = max(own.yz, min(vec2(1.6, 0.6) * pixel, vec2(0.4, 0.15) * long_is)); // thinner arrows would fall between pixels
    value = arrow.foot.w;
    vec3 tip = foot + way;
    float nearest = min(-foot.z, -tip.z) - own.y;
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    if (nearest < 2.0 * near_plane || long_is <= 0.0)
        return;
    vec2 half_size = 0.5 * picture_size, from = ndc_of_eye(foot) * half_size;
    vec2 to = ndc_of_eye(tip) * half_size, dir = to - from;
    dir = length(dir) > 1e-3 ? normalize(dir) : vec2(1.0, 0.0);
    // balls at both ends; longer away from the view's axis, by the slant
    float slant = 1.0 + max(dot(foot.xy, foot.xy) / (foot.z * foot.z), dot(tip.xy, tip.xy) / (tip.z * tip.z));
    float reach = own.y / nearest / view_tangent.y * half_size.y * slant + 1.0;
    vec2 end = (gl_VertexID & 1) == 0 ? from - reach * dir : to + reach * dir;
    vec2 at = end + ((gl_VertexID & 2) == 0 ? -reach : reach) * vec2(-dir.y, dir.x);
    gl_Position = vec4(at / half_size, 0.5, 1.0);
}
