// Step 3 of Tanaka et al. 2012: the lit sum of the sets' pictures; alpha counts the sets with a point in the pixel. Points behind
// solids in the target's depth are left out: a pixel keeps only a set's nearest point.
#include "common/frame.glsl"
#include "common/light.glsl"
#include "common/surface.glsl"
#include "pbsr/sets.glsl"
#ifdef SOLIDS
#include "common/solid_light.glsl"
#endif
layout(binding = COLORMAP_UNIT) uniform sampler2D colormap;
layout(binding = SETS_DEPTH_UNIT) uniform sampler2D target_depth;
layout(std430, binding = SETS_STORAGE) readonly buffer Sets { uint sets[]; };
layout(binding = SETS_OVER_UNIT) uniform sampler2D over_depth;
layout(location = SETS_COUNT_AT) uniform uint set_count;
layout(location = SETS_SIDE_AT) uniform uint side;
layout(location = 0) out vec4 sum;
layout(location = 1) out float nearest; // nearest of the sets' depths, in the front sum

vec3 normal_of(uint word, uint layer)
{
    vec2 e = vec2(word & 1023u, word >> 10 & 1023u) / 1023.0 * 2.0 - 1.0;
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float below = max(-n.z, 0.0);
    n.xy -= below * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    return normalize(n.x * layer_turn[3u * layer].xyz + n.y * layer_turn[3u * layer + 1u].xyz + n.z * layer_turn[3u * layer + 2u].xyz);
}

vec3 value_color(uint code, bool numbers)
{
    if (code == 255u)
        return vec3(1.0, 0.0, 0.6);
    float share = float(code) / 254.0;
    if (numbers) { // fluid numbers: neighbours in the list mix
        float number = share / value_scale + value_low, first = clamp(floor(number), 0.0, 6.0);
        return mix(fluid_color[int(first)].rgb, fluid_color[int(first) + 1].rgb, clamp(number - first, 0.0, 1.0));
    }
    return texelFetch(colormap, ivec2(share * 255.0 + 0.5, 0), 0).rgb;
}

vec3 color_of(uint word, float depth, vec3 ray)
{
    uint layer = word >> 28;
    vec4 own = layer_color[layer];
    vec3 albedo = own.a > 0.0 ? own.rgb : value_color(word >> 20 & 255u, by_fluid != 0u && layer_light[layer].g == 0.0), normal = normal_of(word, layer), view = normalize(ray);
    Surface s = Surface(near_plane / depth * ray, view, dot(normal, view) > 0.0 ? -normal : normal, albedo, 1.0, 1.0, 0.0, 1.0);
#ifdef SOLIDS
    s.key = solid_light(s.place);
#endif
    return mix(albedo, phong(s), shading * layer_light[layer].r);
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy), corner = at - sets_part.xy;
    uint pixel = uint(corner.y) * uint(sets_part.z) + uint(corner.x);
    float behind = texelFetch(target_depth, at, 0).x, over = max(texelFetch(over_depth, at, 0).x, behind);
    float low = side == SETS_FRONT ? over : behind, high = side == SETS_FRONT ? 1.0 : over;
    uint count = low < high ? set_count : 0u; // a count of 0 ends the loop on a software driver; discard would not
    vec3 ray = ray_of_ndc(ndc_of_pixel(gl_FragCoord.xy));
    sum = vec4(0.0);
    nearest = 0.0;
    for (uint set = 0u; set < count; set++) {
        float depth = uintBitsToFloat(sets[set_depth_at(set, pixel)]);
        if (depth <= low || depth > high)
            continue;
        sum += vec4(color_of(sets[set_word_at(set, pixel)], depth, ray), 1.0);
        nearest = max(nearest, depth);
    }
}
