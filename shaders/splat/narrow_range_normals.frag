// Normals of a depth map, for render/views/splat/splat_maps.c. Points of the plane n.P = d are P = z (x, y, -1), so 1 / z = (n.x x +
// n.y y - n.z) / d is linear on the screen, and the slopes of 1 / z give n.
#include "common/frame.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = NEAREST_UNIT) uniform sampler2D depth_map;
layout(binding = NORMAL_SUM_UNIT) uniform sampler2D normal_map;
layout(location = EDGE_STEP_AT) uniform float edge; // m: larger steps are edges, not the surface's slope
layout(location = 0) out vec4 normal;

// Slopes of 1 / z per pixel on both sides along an axis, and the depth steps. Next to the picture's border or a pane, copies the
// other side.
vec4 steps_along(ivec2 pixel, float z, ivec2 along)
{
    bvec2 inside = bvec2(all(greaterThanEqual(pixel, along)), all(lessThan(pixel + along, ivec2(picture_size))));
    vec2 sides = vec2(inside.x ? texelFetch(depth_map, pixel - along, 0).x : z,
                      inside.y ? texelFetch(depth_map, pixel + along, 0).x : z);
    inside = bvec2(inside.x && sides.x > 0.0, inside.y && sides.y > 0.0);
    sides = mix(vec2(z), sides, inside);
    vec4 steps = vec4(vec2(sides.x - z, z - sides.y) / (z * sides), abs(sides - z));
    return inside.x && inside.y ? steps : inside.x ? steps.xxzz : steps.yyww;
}

#ifdef PANES
// The depth at a pixel, clamped to the picture.
float depth_at(ivec2 pixel)
{
    return texelFetch(depth_map, clamp(pixel, ivec2(0), ivec2(picture_size) - 1), 0).x;
}

// Within a quarter of a spacing of a pane, the fluid's top is rounded like its particles, and the filter lacks samples on the
// other side: takes the slope from farther away. Returns false if there is no pane nearby, or another surface. Software drivers
// only skip loops: this loop mostly has no round.
bool slope_beyond(ivec2 pixel, float z, ivec2 along, out float slope)
{
    ivec2 stride = along * int(max(0.04 * particle_spacing * picture_size.y / (view_tangent.y * z) + 0.5, 1.0));
    bool low = depth_at(pixel - 3 * stride) < 0.0, high = depth_at(pixel + 3 * stride) < 0.0, found = false;
    slope = 0.0;
    for (int rounds = low != high ? 1 : 0; rounds > 0; rounds--) {
        int away = low ? 1 : -1;
        float first = depth_at(pixel + 4 * away * stride), second = depth_at(pixel + 8 * away * stride);
        slope = float(away) * (first - second) / (4.0 * float(stride.x + stride.y) * first * second);
        found = min(first, second) > 0.0 && max(abs(first - z), abs(second - first)) < 2.0 * edge;
    }
    return found;
}
#endif

// The mean slope of both sides; at an edge, where the sides differ, the slope of the smaller step. Returns false if the smaller
// step is an edge too.
bool slope_along(ivec2 pixel, float z, ivec2 along, out float slope)
{
#ifdef PANES
    if (slope_beyond(pixel, z, along, slope))
        return true;
#endif
    vec4 steps = steps_along(pixel, z, along);
    bool even = abs(steps.x - steps.y) * z * z < edge;
    slope = even ? 0.5 * (steps.x + steps.y) : steps.z < steps.w ? steps.x : steps.y;
    return even || min(steps.z, steps.w) < edge;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float z = texelFetch(depth_map, pixel, 0).x;
    vec2 slopes;
    if (z >= 1e29) {
        normal = vec4(0.0);
    } else if (z < 0.0) { // a pane of the box: shading handles panes
        normal = vec4(0.0, 0.0, 1.0, 0.0);
    } else if (slope_along(pixel, z, ivec2(1, 0), slopes.x) && slope_along(pixel, z, ivec2(0, 1), slopes.y)) {
        slopes *= 0.5 * picture_size / view_tangent;
        vec2 ray = ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy)).xy;
        normal = vec4(normalize(vec3(-slopes, 1.0 / z - dot(ray, slopes))), 0.0);
    } else { // a thread or drop of one pixel: uses the blended normal
        vec3 blended = texelFetch(normal_map, pixel, 0).xyz;
        normal = dot(blended, blended) > 0.0 ? vec4(normalize(blended), 0.0) : vec4(0.0);
    }
}
