// A piece of each trail, from the previous column to the present: four vertices per trail. A piece starts perpendicular to the
// trail's incoming direction and ends perpendicular to its own: neighbouring pieces share edges, so no pixel is covered twice or
// missed.
#include "common/frame.glsl"
#include "common/line.glsl"
#include "shaders/trails/trails_bindings.h"

layout(std430, binding = TRAIL_PLACES_STORAGE) readonly buffer Places { vec4 places[]; };
layout(std430, binding = TRAIL_OWNERS_STORAGE) readonly buffer Owners { uint owners[]; };
layout(location = TRAIL_COLUMN_AT) uniform uint column; // first element of the column
layout(location = TRAIL_BEFORE_AT) uniform uint before;
layout(location = TRAIL_EARLIER_AT) uniform uint earlier; // or TRAIL_NO_COLUMN
layout(location = TRAIL_WRAP_AT) uniform vec3 wrap;       // longer distances cross a periodic side, m
layout(location = TRAIL_TIMES_AT) uniform vec2 times;     // times of the previous and the present column
layout(location = HALF_WIDTH_AT) uniform float half_width;
layout(location = 0) noperspective out float across; // pixels from the line's middle
layout(location = 1) noperspective out vec2 stamp;   // time and scalar

// True if a line leads from `from` to `to`.
bool joined(uint from, uint to)
{
    bool one = owners[from] != 0u && owners[from] >> 1u == owners[to] >> 1u && (owners[to] & 1u) != 0u;
    return one && all(lessThanEqual(abs(places[to].xyz - places[from].xyz), wrap));
}

vec3 eye_of(uint at)
{
    return (box_to_eye * vec4(places[at].xyz, 1.0)).xyz;
}

void main()
{
    uint slot = uint(gl_VertexID) >> 2, a = before + slot, b = column + slot;
    across = 0.0;
    stamp = vec2(0.0);
    gl_Position = vec4(2.0, 2.0, 0.0, 1.0);
    if (!joined(a, b))
        return;
    vec3 from = eye_of(a), to = eye_of(b);
    if (max(from.z, to.z) > -2.0 * near_plane && min(from.z, to.z) > -2.0 * near_plane)
        return;
    float start = cut(from.z, to.z), stop = 1.0 - cut(to.z, from.z);
    vec3 first = mix(from, to, start), last = mix(from, to, stop);
    vec2 along = pixels_of(last) - pixels_of(first), side = across_of(along);
    if ((gl_VertexID & 1) == 0 && earlier != TRAIL_NO_COLUMN && start == 0.0 && joined(earlier + slot, a)) {
        vec3 came_from = eye_of(earlier + slot);
        vec2 came = pixels_of(first) - pixels_of(came_from);
        side = came_from.z < -2.0 * near_plane && dot(came, along) > 0.0 ? across_of(came) : side;
    }
    float share = (gl_VertexID & 1) == 0 ? start : stop;
    vec3 here = mix(from, to, share);
    across = ((gl_VertexID & 2) == 0 ? -1.0 : 1.0) * (half_width + 0.5);
    stamp = vec2(mix(times.x, times.y, share), mix(places[a].w, places[b].w, share));
    gl_Position = clip_of_eye(here);
    gl_Position.xy += side * across * 2.0 * pixel_size * -here.z;
}
