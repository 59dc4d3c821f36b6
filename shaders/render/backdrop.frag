// The sky as a gradient, and the floor that fades into it; with FLOOR_SHADOW less what the fluid shades.
#include "common/frame.glsl"

#ifdef FLOOR_SHADOW
layout(binding = 3) uniform sampler2D floor_light;
#endif
layout(location = 0) flat in vec3 ray_corner;
layout(location = 1) flat in vec3 ray_x;
layout(location = 2) flat in vec3 ray_y;
layout(location = 0) out vec4 color;

// Breaks the bands that 8 bits would show; after Jimenez, Next generation post processing in Call of Duty, 2014.
float grain()
{
    return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
}

float sky_brightness(vec3 ray)
{
    float rise = clamp(0.5 + 0.9 * ray.y * inversesqrt(dot(ray, ray)), 0.0, 1.0);
    return 1.04 - 0.42 * rise * rise;
}

// Brightness and how much of it is left of the fading, at the place where the ray meets the floor.
vec2 floor_brightness(vec3 ray)
{
    vec2 xz = eye_to_world[3].xz + (floor_place.x - eye_to_world[3].y) / min(ray.y, -1e-6) * ray.xz;
    float lit = 1.0;
#ifdef FLOOR_SHADOW
    lit = textureLod(floor_light, (xz - floor_map.xy) / floor_map.zw, 0.0).x;
#endif
    vec2 away = (xz - floor_place.yz) / max(floor_place.w, 1e-6);
    float left = max(1.0 - dot(away, away), 0.0);
    return vec2(1.12 * (0.40 + 0.60 * lit), left * left);
}

void main()
{
    vec3 ray = ray_corner + gl_FragCoord.x * ray_x + gl_FragCoord.y * ray_y;
    vec2 ground = floor_brightness(ray);
    bool above = ray.y < 0.0 && eye_to_world[3].y > floor_place.x;
    float brightness = mix(sky_brightness(ray), ground.x, above && floor_place.w > 0.0 ? ground.y : 0.0);
    color = vec4(background.rgb * (brightness + grain() * (1.5 / 255.0)), 1.0);
}
