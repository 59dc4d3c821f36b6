// Four vertices per particle: the square around the ball's section with the plane; none without a section.
#include "common/particles.glsl"
#include "common/particle_scalars.glsl"
#include "common/nan.glsl"
#include "shaders/shared/plane_block.h"

layout(location = 0) flat out ivec2 cell;  // the sample of the centre
layout(location = 1) flat out vec4 disc;   // position in the sample, 0 .. 1; (distance / h)^2; V times the kernel's peak
layout(location = 2) flat out vec2 scalar; // value; 1 if NaN

// True if the plane is out of the ball's reach, in single precision: a GPU may need a hundred times as long for doubles.
bool far_away(vec3 place)
{
    vec3 corner = vec3(plane_corner), normal = vec3(plane_normal);
    float rounding = 1e-6 * dot(abs(place) + abs(corner), abs(normal));
    return abs(dot(place - corner, normal)) > 1.0 + rounding;
}

void main()
{
    uint index = uint(gl_VertexID) >> 2;
    vec3 place = particle_position(index);
    float volume = position_words[index * position_stride + 3u];
    float value = scalar_stride > 0u ? scalar_words[index * scalar_stride] : 0.0;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    cell = ivec2(0);
    disc = vec4(0.0);
    scalar = vec2(0.0);
    if (far_away(place))
        return;
    dvec3 from_corner = dvec3(place) - plane_corner;
    float away = float(dot(from_corner, plane_normal)), left = 1.0 - away * away;
    if (is_nan(vec4(place, volume)) || left <= 0.0 || volume <= 0.0 || volume > 1e30)
        return;
    dvec2 centre = dvec2(dot(from_corner, plane_along), dot(from_corner, plane_up));
    bool known = !is_nan(value) && abs(value) < 1e30;
    cell = ivec2(floor(centre));
    disc = vec4(centre - dvec2(cell), away * away, volume * plane_peak);
    scalar = known ? vec2(value, 0.0) : vec2(0.0, 1.0);
    // a margin, since rasterisers round positions to 1/256 of a sample
    vec2 half_side = sqrt(left) * plane_support / plane_side + 1.0 / 64.0;
    vec2 corner = vec2(centre) + half_side * (vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1) * 2.0 - 1.0);
    gl_Position = vec4(corner / plane_samples * 2.0 - 1.0, 0.0, 1.0);
}
