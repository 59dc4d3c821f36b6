// Colour and light at positions in the volume. Needs volume/raycast_ray.glsl, common/light.glsl.
#include "shaders/volume/volume_bindings.h"
layout(binding = COLORMAP_UNIT) uniform sampler2D colormap;

#ifdef SCALAR
#ifdef FIELD_DIRECT
float scalar_at(vec3 at)
{
    vec2 sums = field_sum(at * volume_cells);
    return sums.x > 0.0 ? sums.y / sums.x : 0.0;
}
#else
layout(binding = FIELD_SCALAR_UNIT) uniform sampler3D field_scalar_map;

// The scalar's mean, weighted by the field.
float scalar_at(vec3 at)
{
    float field = field_at(at);
    return field > 0.0 ? textureLod(field_scalar_map, clamp(at, field_low, field_high), 0.0).x / field : 0.0;
}
#endif

#ifdef TINTED // the scalar's sum is of the fluids' red
layout(binding = GREEN_UNIT) uniform sampler3D green_map;
layout(binding = BLUE_UNIT) uniform sampler3D blue_map;
#endif

// `share`: position of the scalar in its range, 0..1.
vec3 albedo_at(vec3 at, out float share)
{
#ifdef TINTED
    float field = field_at(at);
    vec3 place = clamp(at, field_low, field_high);
    share = 1.0;
    return vec3(textureLod(field_scalar_map, place, 0.0).x, textureLod(green_map, place, 0.0).x, textureLod(blue_map, place, 0.0).x) /
           max(field, 1e-12);
#else
    float value = scalar_at(at);
    if (by_fluid != 0u) { // fluid numbers: neighbours in the list mix
        float first = clamp(floor(value), 0.0, 6.0);
        share = 1.0;
        return mix(fluid_color[int(first)].rgb, fluid_color[int(first) + 1].rgb, clamp(value - first, 0.0, 1.0));
    }
    share = clamp((value - range_low) * range_scale, 0.0, 1.0);
    return texelFetch(colormap, ivec2(share * 255.0 + 0.5, 0), 0).rgb;
#endif
}
#else
vec3 albedo_at(vec3 at, out float share)
{
    share = 1.0;
    return fluid_color[0].rgb;
}
#endif

#ifdef SHADOWS
// The fraction of light through the fluid between a place and the light. As fluid_light_at, with the length of fluid on the way
// instead of the depth below the first lit surface.
float lit_at(vec3 place)
{
    Ray ray = ray_from(place, light_in_eye);
    const float longest = 8.0 * particle_radius; // beyond this length almost no light is left
    float dt = 2.0 * step_length, t = dt, way = 0.0, end = ray_end(ray);
    while (t < end && way < longest) {
        float f = min(field_at(ray_at(ray, t)), 1.0), on = f > 0.0 ? dt : max(dt, far_step);
        way += on * f;
        t += on;
    }
    return 0.12 + 0.88 * exp2(-0.55 * way / max(particle_radius, 1e-9));
}
#else
float lit_at(vec3 place)
{
    return fluid_light(place, gl_FragCoord.xy);
}
#endif

// `lit`: fraction of the key light after the fluid; returns the fraction after fluid and solids.
float key_at(vec3 place, float lit)
{
#ifdef SOLIDS
    return lit * solid_light(place);
#else
    return lit;
#endif
}
