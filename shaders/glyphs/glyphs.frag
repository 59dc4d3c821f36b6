// A shaft and a cone, at the first hit of the pixel's ray: exact in each pixel, like the quadrics of paper 004.
#include "common/frame.glsl"
#include "common/nan.glsl"
#include "shaders/glyphs/glyphs_bindings.h"

layout(binding = COLORMAP_UNIT) uniform sampler2D colormap;
layout(location = GLYPH_IS_FLUID_AT) uniform uint is_fluid;
layout(location = GLYPH_COLOR_AT) uniform vec4 plain; // alpha 1: all arrows have this colour
layout(location = 0) flat in vec3 foot;
layout(location = 1) flat in vec4 axis;
layout(location = 2) flat in vec3 own;
layout(location = 3) flat in float value;
layout(location = 0) out vec4 color;

const float far = 1e30;

struct Hit {
    float t; // along the ray
    vec3 normal;
};

// The nearest hit of a cylinder or cone, with radius `wide` - slope s at s along the axis, between low and high.
Hit meet(Hit best, vec3 ray, vec3 from, float low, float high, float wide, float slope)
{
    float rs = dot(ray, axis.xyz), fs = dot(from, axis.xyz), bound = wide - slope * fs;
    vec3 rp = ray - rs * axis.xyz, fp = from - fs * axis.xyz;
    float a = dot(rp, rp) - slope * slope * rs * rs, b = dot(rp, fp) + slope * rs * bound, c = dot(fp, fp) - bound * bound;
    float root = b * b - a * c;
    for (int side = -1; side <= 1; side += 2) {
        float t = (-b + float(side) * sqrt(max(root, 0.0))) / a, s = fs + t * rs;
        if (root < 0.0 || abs(a) < 1e-12 || t <= 0.0 || t >= best.t || s < low || s > high)
            continue;
        best = Hit(t, normalize(normalize(fp + t * rp) + slope * axis.xyz));
    }
    return best;
}

// The disc that closes the cylinder or cone at its foot.
Hit meet_disc(Hit best, vec3 ray, vec3 from, float at, float radius)
{
    float t = (at - dot(from, axis.xyz)) / dot(ray, axis.xyz);
    vec3 x = from + t * ray - at * axis.xyz;
    return t > 0.0 && t < best.t && dot(x, x) <= radius * radius ? Hit(t, -axis.xyz) : best;
}

vec3 albedo()
{
    float level = clamp((value - range_low) * range_scale, 0.0, 1.0) * 255.0 + 0.5;
    if (plain.a > 0.0)
        return plain.rgb;
    if (is_nan(value))
        return no_number_color;
    return is_fluid != 0u ? fluid_color[uint(value + 0.5) & 7u].rgb : texelFetch(colormap, ivec2(level, 0), 0).rgb;
}

void main()
{
    vec3 ray = ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy)), from = -foot;
    float neck = axis.w - own.x, slope = own.y / own.x;
    Hit hit = meet(Hit(far, vec3(0.0)), ray, from, 0.0, neck, own.z, 0.0);
    hit = meet(hit, ray, from, neck, axis.w, slope * axis.w, slope);
    hit = meet_disc(meet_disc(hit, ray, from, 0.0, own.z), ray, from, neck, own.y);
    if (hit.t >= far)
        discard;
    vec3 base = albedo(), sky = mix(ground_color, sky_color, 0.5 + 0.5 * dot(hit.normal, up_in_eye));
    vec3 lit = base * (sky + light_color * max(dot(hit.normal, light_in_eye), 0.0));
    color = vec4(mix(base, lit, shading), 1.0);
    gl_FragDepth = near_plane / hit.t;
}
