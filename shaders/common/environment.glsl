// Sky and lit floor, from any position in any direction of the world; with FLOOR_SHADOW, with shadows of fluid and solids. Needs
// common/frame.glsl.
#include "shaders/shared/bindings.h"
#ifdef FLOOR_SHADOW
layout(binding = FLOOR_LIGHT_UNIT) uniform sampler2D floor_light;
#endif

float sky_brightness(vec3 ray)
{
    float rise = clamp(0.5 + 0.9 * ray.y * inversesqrt(dot(ray, ray)), 0.0, 1.0);
    return 1.04 - 0.42 * rise * rise;
}

// Tiles, a sixteenth of the floor's radius wide: through water, tiles show the refraction. The edges are soft without
// derivatives, which a refracted ray does not have.
float floor_tiles(vec2 from_center)
{
    vec2 wave = sin(16.0 * 3.14159265 * from_center);
    return 1.0 - 0.09 * smoothstep(-0.04, 0.04, wave.x * wave.y);
}

// Brightness of the floor where the ray meets the floor, and the rest of the fading there.
vec2 floor_brightness(vec3 origin, vec3 ray)
{
    vec2 xz = origin.xz + (floor_height - origin.y) / min(ray.y, -1e-6) * ray.xz;
    float lit = 1.0;
#ifdef FLOOR_SHADOW
    lit = textureLod(floor_light, (xz - floor_map_corner) / floor_map_size, 0.0).x;
#endif
    vec2 away = (xz - floor_center) / max(floor_radius, 1e-6);
    float left = max(1.0 - dot(away, away), 0.0);
    return vec2(1.16 * (0.40 + 0.60 * lit) * floor_tiles(away), left * left);
}

// Linear light. The sky gets bluer with height.
vec3 environment_light(vec3 origin, vec3 ray)
{
    vec2 ground = floor_brightness(origin, ray);
    bool above = ray.y < 0.0 && origin.y > floor_height;
    float floor_share = above && floor_radius > 0.0 ? ground.y : 0.0, sky = sky_brightness(ray), height = (1.04 - sky) / 0.42;
    return background * mix(sky * mix(vec3(1.0), vec3(0.70, 0.90, 1.10), height), vec3(ground.x), floor_share);
}
