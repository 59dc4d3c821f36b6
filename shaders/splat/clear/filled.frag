// The thickness of render/views/splat/splat_private.h if fluid filled the box up to the first solid: the field of such a fluid along the
// ray. Beside a wall the field is below 1, beside an edge even lower, like the particles' field.
#include "common/frame.glsl"
#include "common/within_box.glsl"
#include "shaders/splat/splat_bindings.h"

#ifdef SOLIDS
layout(binding = TARGET_DEPTH_UNIT) uniform sampler2D solid_depth; // the target's, reversed
#endif
layout(location = MAP_SIZE_AT) uniform vec2 texels;
layout(location = SPLAT_RADIUS_AT) uniform float support; // radius of the kernel, m
layout(location = 0) out float filled;

// Gauss-Legendre: nodes in -1 .. 1, weights.
const vec2 five[5] = vec2[](vec2(-0.90617985, 0.23692689), vec2(-0.53846931, 0.47862867), vec2(0.0, 0.56888889), vec2(0.53846931, 0.47862867),
                            vec2(0.90617985, 0.23692689));
const vec2 three[3] = vec2[](vec2(-0.77459667, 0.55555556), vec2(0.0, 0.88888889), vec2(0.77459667, 0.55555556));

// The field at a distance inside a flat wall, in supports: poly6 integrated over the planes of the kernel's ball.
vec3 beside_wall(vec3 within)
{
    vec3 q = clamp(within, -1.0, 1.0), q2 = q * q;
    return 0.5 + 315.0 / 256.0 * q * (1.0 - q2 * (4.0 / 3.0 - q2 * (6.0 / 5.0 - q2 * (4.0 / 7.0 - q2 / 9.0))));
}

float field_at(vec3 place) // in the box's frame
{
    vec3 low = vec3(-0.5, 0.0, -0.5) * box_size;
    vec3 axes = beside_wall((place - low) / support) + beside_wall((low + box_size - place) / support) - 1.0;
    return axes.x * axes.y * axes.z;
}

// Distance along a ray to the first solid, in lengths of the ray.
float solid_at(vec2 at)
{
#ifdef SOLIDS
    ivec2 pixel = min(ivec2(at * picture_size), ivec2(picture_size) - 1);
    return near_plane / max(texelFetch(solid_depth, pixel, 0).x, 1e-30);
#else
    return 1e30;
#endif
}

// The field falls off near the walls: both ends of the ray have separate samples, starting outside.
void main()
{
    vec2 at = gl_FragCoord.xy / texels;
    vec3 ray = ray_of_ndc(2.0 * at - 1.0), way = ray * mat3(box_to_eye), origin = -box_to_eye[3].xyz * mat3(box_to_eye);
    Within box = within_box_of(ray, bvec3(true));
    float per_m = 1.0 / length(ray), reach = 2.0 * support * per_m, solid = solid_at(at);
    float enter = max(min(box.enter, 0.5 * (box.enter + box.leave)), near_plane), leave = max(box.leave, enter), sum = 0.0;
    float end = min(leave + reach, solid), inner = min(reach, 0.5 * max(min(leave, solid) - enter, 0.0));
    vec4 stops = vec4(enter - reach, enter + inner, max(min(leave, solid) - inner, enter + inner), end);
    for (int i = 0; i < 5; i++)
        sum += five[i].y * (max(stops.y - stops.x, 0.0) * field_at(origin + mix(stops.x, stops.y, 0.5 + 0.5 * five[i].x) * way) +
                            max(stops.w - stops.z, 0.0) * field_at(origin + mix(stops.z, stops.w, 0.5 + 0.5 * five[i].x) * way));
    for (int i = 0; i < 3; i++)
        sum += three[i].y * (stops.z - stops.y) * field_at(origin + mix(stops.y, stops.z, 0.5 + 0.5 * three[i].x) * way);
    filled = 0.5 * sum / per_m;
}
