// Sky and lit floor, from any position in any direction of the world; with FLOOR_SHADOW, with shadows of fluid and solids. Needs
// common/frame.glsl.
#include "shaders/shared/bindings.h"
#ifdef FLOOR_SHADOW
layout(binding = FLOOR_LIGHT_UNIT) uniform sampler2D floor_light;
#endif

const float horizon_brightness = 2.1; // times the background

// A wave from 0 to 1 with period 1, smooth as a sine and cheaper.
vec2 waves(vec2 at)
{
    vec2 away = abs(fract(at) - 0.5);
    return away * away * (12.0 - 16.0 * away);
}

// Soft clouds overhead, 0 to 1, none near the horizon. `ray`: a unit vector.
float clouds(vec3 ray)
{
    vec2 at = ray.xz / (0.4 + max(ray.y, 0.0)), bent = at + 0.35 * waves(1.3 * at.yx + 0.2), wave = waves(0.9 * bent);
    return wave.x * wave.y * clamp(3.0 * ray.y, 0.0, 1.0);
}

// Bright at the horizon, darker and bluer above, with clouds and light around the sun. `ray`: a unit vector.
vec3 sky(vec3 ray)
{
    float haze = 1.0 / (1.0 + 24.0 * ray.y * ray.y), sun = max(dot(ray, light_in_world), 0.0);
    sun *= sun, sun *= sun, sun *= sun;
    vec3 clear = mix(ray.y > 0.0 ? vec3(0.75, 0.95, 1.20) : vec3(1.0), vec3(horizon_brightness), haze);
    return background * (clear + vec3(0.75, 0.70, 0.62) * clouds(ray) + vec3(1.2, 1.0, 0.7) * sun);
}

// Tiles, a sixteenth of the floor's radius wide: through water, tiles show the refraction. The edges are soft without
// derivatives, which a refracted ray does not have.
float floor_tiles(vec2 from_center)
{
    vec2 odd = smoothstep(0.46, 0.54, waves(8.0 * from_center + 0.25));
    return 1.10 - 0.36 * (odd.x + odd.y - 2.0 * odd.x * odd.y);
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

// Linear light.
vec3 environment_light(vec3 origin, vec3 ray)
{
    vec3 light = sky(ray * inversesqrt(dot(ray, ray)));
    if (ray.y >= 0.0 || origin.y <= floor_height || floor_radius <= 0.0)
        return light;
    vec2 ground = floor_brightness(origin, ray);
    return mix(light, background * ground.x, ground.y);
}
