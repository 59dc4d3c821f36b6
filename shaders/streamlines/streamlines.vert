// A piece of a line: four vertices. A piece starts across the direction of the piece before, as in trails.
#include "common/frame.glsl"
#include "common/line.glsl"
#include "shaders/shared/bindings.h"
#include "shaders/streamlines/streamlines_bindings.h"

layout(std430, binding = STREAM_POINTS_STORAGE) readonly buffer Points { vec4 points[]; };
layout(location = STREAM_STEPS_AT) uniform uint steps;
layout(location = STREAM_LIFT_AT) uniform float lift; // towards the eye, m
layout(location = HALF_WIDTH_AT) uniform float half_width;
layout(location = 0) noperspective out float across; // pixels from the line's middle
layout(location = 1) out float value;

vec3 eye_of(uint at)
{
    vec3 place = (box_to_eye * vec4(points[at].xyz, 1.0)).xyz;
    return place * (1.0 - min(lift / length(place), 0.5));
}

void main()
{
    uint piece = uint(gl_VertexID) >> 2, pieces = 2u * steps, k = piece % pieces, a = piece / pieces * (pieces + 1u) + k, b = a + 1u;
    float clear = -2.0 * near_plane;
    across = 0.0;
    value = 0.0;
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    if (points[a].xyz == points[b].xyz)
        return;
    vec3 from = eye_of(a), to = eye_of(b);
    if (from.z > clear && to.z > clear)
        return;
    float start = cut(from.z, to.z), stop = 1.0 - cut(to.z, from.z);
    vec3 first = mix(from, to, start), last = mix(from, to, stop);
    vec2 along = pixels_of(last) - pixels_of(first), side = across_of(along);
    bool at_start = (gl_VertexID & 1) == 0;
    if (at_start && start == 0.0 && k > 0u && points[a - 1u].xyz != points[a].xyz) {
        vec3 before = eye_of(a - 1u);
        vec2 came = pixels_of(first) - pixels_of(before);
        side = before.z < clear && dot(came, along) > 0.0 ? across_of(came) : side;
    }
    float share = at_start ? start : stop;
    vec3 here = mix(from, to, share);
    across = ((gl_VertexID & 2) == 0 ? -1.0 : 1.0) * (half_width + 0.5);
    value = mix(points[a].w, points[b].w, share);
    gl_Position = clip_of_eye(here);
    gl_Position.xy += side * across * 2.0 * pixel_size * -here.z;
}
