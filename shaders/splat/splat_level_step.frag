// Finds the first position where the field rises to the level, between samples of value and slope: cubic Hermite pieces. Without
// a root, continues behind: at once if the field is above zero, else from the next sphere.
#include "common/frame.glsl"
#include "common/nan.glsl"
#include "shaders/splat/splat_bindings.h"

layout(binding = NEAREST_UNIT) uniform sampler2D start_map;
layout(binding = MARCH_UNIT) uniform sampler2D march_map; // end of the searched range, m; value and slope per radius there; 1: found
layout(binding = VALUE_UNIT) uniform sampler2D value_map;
layout(binding = SLOPE_UNIT) uniform sampler2D slope_map;
layout(location = APART_AT) uniform float apart;           // radii between samples
layout(location = APART_NEXT_AT) uniform float apart_next; // in the next round
layout(location = LEVEL_AT) uniform float level;           // divided by the gain
layout(location = 0) out vec4 march;
layout(location = 1) out float start;

// Value minus the level: c.x + t (c.y + t (c.z + t c.w)) for t = 0 .. 1.
vec4 hermite(vec2 value, vec2 slope)
{
    float rise = value.y - value.x;
    return vec4(value.x - level, slope.x, 3.0 * rise - 2.0 * slope.x - slope.y, slope.x + slope.y - 2.0 * rise);
}

float at(vec4 c, float t)
{
    return c.x + t * (c.y + t * (c.z + t * c.w));
}

// Position of the maximum, for a piece that rises at the first end and falls at the second.
float top_of(vec4 c)
{
    return c.y / (sqrt(max(c.z * c.z - 3.0 * c.w * c.y, 0.0)) - c.z);
}

// The first t where the piece rises to 0, or 2.
float crossing(vec4 c, float value, float slope)
{
    float low = 0.0, high = 1.0;
    if (value < level) {
        if (c.y <= 0.0 || slope >= 0.0)
            return 2.0;
        high = top_of(c);
        float top = at(c, high);
        if (is_nan(top) || top < 0.0)
            return 2.0;
    }
    for (int i = 0; i < 10; i++) {
        float middle = 0.5 * (low + high);
        if (at(c, middle) < 0.0)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 before = texelFetch(march_map, pixel, 0);
    float from = texelFetch(start_map, pixel, 0).x;
    if (before.w > 0.0 || from >= 1e29)
        discard;
    vec4 value = texelFetch(value_map, pixel, 0), slope = texelFetch(slope_map, pixel, 0) * apart;
    float a = before.y, b = before.z * apart, reach = apart * particle_radius, end = from + 4.0 * reach;
    for (int i = 0; i < 4; i++) {
        float t = crossing(hermite(vec2(a, value[i]), vec2(b, slope[i])), value[i], slope[i]);
        if (t <= 1.0) {
            march = vec4(end, 0.0, 0.0, 1.0);
            start = from + (float(i) + t) * reach;
            gl_FragDepth = 1.0;
            return;
        }
        a = value[i], b = slope[i];
    }
    bool gap = a <= 0.0;
    march = vec4(end, a, b / apart, 0.0);
    start = gap ? 1e30 : end;
    gl_FragDepth = gap ? 0.0 : near_plane / (end + 4.0 * apart_next * particle_radius);
}
