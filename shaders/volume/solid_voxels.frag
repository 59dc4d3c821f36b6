// A solid as voxels of its distance: the first point on the ray with a distance below 0. After: J. Hart, Sphere tracing, 1996.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "common/solid_light.glsl"
#include "common/surface.glsl"
#include "common/solid.glsl"
#include "shaders/volume/volume_bindings.h"

layout(location = SOLID_TO_EYE_AT) uniform mat4 solid_to_eye;
layout(location = SOLID_LOW_AT) uniform vec3 block_low; // m, the solid's frame
layout(location = SOLID_HIGH_AT) uniform vec3 block_high;
layout(location = SOLID_COLOR_AT) uniform vec3 albedo;
layout(location = SOLID_CELL_AT) uniform float cell; // m
layout(binding = FIELD_UNIT) uniform sampler3D distance_map;
layout(location = 0) out vec4 color;

// m; texels are at the corners of cells, the outermost texels at the block's sides.
float distance_at(vec3 at)
{
    vec3 texels = vec3(textureSize(distance_map, 0));
    return textureLod(distance_map, ((at - block_low) / cell + 0.5) / texels, 0.0).x;
}

// The root between `before`, outside, with distance d, and `behind`, with distance e: regula falsi with the Illinois rule.
float refined(vec3 from, vec3 to, float before, float d, float behind, float e)
{
    float here = before;
    for (int i = 0; i < 4; i++) {
        here = before + (behind - before) * (d / (d - e));
        float value = distance_at(from + here * to);
        if (value > 0.0)
            before = here, d = value, e *= 0.5;
        else
            behind = here, e = value, d *= 0.5;
    }
    return here;
}

// Distance along the eye's axis, m; 0: no hit. From inside, the ray continues to the next entry: back faces of other solids are
// not drawn either.
float find(vec3 from, vec3 to, float begin, float end)
{
    float per_m = 1.0 / length(to), t = begin, before = t, d = distance_at(from + t * to), last = d;
    while (t < end && (d > 0.0 || last <= 0.0)) {
        before = t, last = d;
        t = min(t + max(0.8 * abs(d), 0.25 * cell) * per_m, end); // interpolated distances are slightly too large
        d = distance_at(from + t * to);
        if (t >= end && d > 0.0)
            return 0.0;
    }
    return last > 0.0 && d <= 0.0 ? refined(from, to, before, last, t, d) : 0.0;
}

vec3 normal_at(vec3 at)
{
    const vec2 k = vec2(1.0, -1.0);
    float reach = 0.5 * cell;
    vec3 slope = k.xyy * distance_at(at + k.xyy * reach) + k.yyx * distance_at(at + k.yyx * reach) +
                 k.yxy * distance_at(at + k.yxy * reach) + k.xxx * distance_at(at + k.xxx * reach);
    return normalize(mat3(solid_to_eye) * slope + vec3(0.0, 0.0, 1e-12));
}

void main()
{
    vec3 ray = ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy));
    vec3 from = -transpose(mat3(solid_to_eye)) * solid_to_eye[3].xyz, to = transpose(mat3(solid_to_eye)) * ray;
    vec3 a = (block_low - from) / to, b = (block_high - from) / to, enter = min(a, b), leave = max(a, b);
    float begin = max(max(max(enter.x, enter.y), enter.z), near_plane), end = min(min(leave.x, leave.y), leave.z);
    if (begin >= end)
        discard;
    float t = find(from, to, begin, end);
    if (t <= 0.0)
        discard;
    color = vec4(solid_surface(t * ray, normal_at(from + t * to), albedo), 1.0);
    gl_FragDepth = near_plane / t;
}
