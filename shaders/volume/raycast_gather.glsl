// The light that a ray gathers through translucent fluid, from front to back. Needs volume/raycast_surface.glsl for `steps` and
// volume/raycast_light.glsl. After: Max, Optical models for direct volume rendering, 1995.
#include "common/noise.glsl"

// Light from a piece of fluid to the eye: the skin as a lit surface, the body evenly, since light inside comes from everywhere.
vec3 glow_at(Ray ray, float t, vec3 albedo, float skin)
{
    vec3 place = ray.from + t * ray.to, skinned = vec3(0.0);
    if (shading < 0.5)
        return albedo;
    float lit = lit_at(place), key = key_at(place, lit);
    if (skin > 0.0)
        skinned = phong(Surface(place, ray.to / ray.slant, normal_at(ray, t), albedo, lit, key, 0.0, 1.0));
    vec3 sky = mix(ground_color, sky_color, 0.5) * (0.35 + 0.65 * lit);
    return mix(albedo * (sky + 0.5 * key * light_color), skinned, skin);
}

// A part of the ray: optical depths of body and skin, and the mean position.
struct Piece {
    float body, skin, at;
};

#if defined CURVED || defined OPACITY
layout(binding = TRANSFER_UNIT) uniform sampler2D transfer_table; // render/views/volume/volume_private.h

vec4 transfer_at(float x)
{
    return textureLod(transfer_table, vec2((clamp(x, 0.0, 1.0) * 255.0 + 0.5) / 256.0, 0.5), 0.0);
}
#endif

#ifdef CURVED
// Position of the field on the transfer function's ramp, unclamped.
float ramp_of(float f)
{
    return (f - ramp_begin) * ramp_scale;
}

float curve_sum(float x)
{
    vec4 here = transfer_at(x);
    return x <= 0.0 ? 0.0 : here.y + max(x - 1.0, 0.0) * here.x;
}

// The mean of the curve between two positions on the ramp: for fluid on the way between both.
float body_between(float from, float to)
{
    float middle = 0.5 * (from + to);
    if (abs(to - from) < 1e-3 || min(from, to) >= 1.0 || max(from, to) <= 0.0)
        return middle <= 0.0 ? 0.0 : transfer_at(middle).x;
    return (curve_sum(to) - curve_sum(from)) / (to - from);
}

// Total rise and fall of the curve between two positions.
float skin_between(float from, float to)
{
    return abs((to <= 0.0 ? 0.0 : transfer_at(to).z) - (from <= 0.0 ? 0.0 : transfer_at(from).z));
}
#else
// Position of the field on the transfer function's ramp.
float ramp_of(float f)
{
    return clamp((f - ramp_begin) * ramp_scale, 0.0, 1.0);
}

float body_between(float from, float to)
{
    return 0.5 * (from + to);
}

float skin_between(float from, float to)
{
    return abs(to - from);
}
#endif

// Opacity by a scalar: OPACITY 1 by the colours' scalar, 2 by another scalar.
#if !defined OPACITY
float opacity_at(vec3 at)
{
    return 1.0;
}
#else
#if OPACITY == 2
layout(binding = OPACITY_FIELD_UNIT) uniform sampler3D opacity_field_map;
layout(binding = OPACITY_SCALAR_UNIT) uniform sampler3D opacity_scalar_map;

float opacity_scalar_at(vec3 at)
{
    float field = textureLod(opacity_field_map, at, 0.0).x;
    return field > 0.0 ? textureLod(opacity_scalar_map, at, 0.0).x / field : 0.0;
}
#else
float opacity_scalar_at(vec3 at)
{
    return scalar_at(at);
}
#endif

float opacity_at(vec3 at)
{
    return transfer_at((opacity_scalar_at(at) - opacity_low) * opacity_scale).w;
}
#endif

// Marches on from t, where the field is f, until the piece is worth shading. Extinction is linear between samples, and the skin's
// extinction follows the ramp's rise or fall: both are independent of the distance between samples.
Piece next_piece(Ray ray, float dt, inout float t, inout float f, inout float next)
{
    const float enough = 0.1; // a tenth of the opacity, and half of the skin
    Piece piece = Piece(0.0, 0.0, 0.0);
    float ramp = ramp_of(f);
    while (t < ray.end && piece.body < enough && piece.skin <= skin_depth * 0.5) {
        next = min(next, ray.end);
        f = field_at(ray_at(ray, next));
        float after = ramp_of(f), body = body_between(ramp, after) * (next - t) * ray.slant * extinction,
              skin = skin_between(ramp, after) * skin_depth;
        piece.body += body;
        piece.skin += skin;
        piece.at += (body + skin) * 0.5 * (t + next);
        steps++;
        ramp = after, t = next, next += max(dt, f < ramp_begin ? step_from(f, ramp_begin) / ray.slant : 0.0);
    }
    piece.at /= max(piece.body + piece.skin, 1e-30);
    return piece;
}

// Returns premultiplied colour and opacity. `half_way`: t where half of the light is lost; 0: never.
vec4 gather(Ray ray, out float half_way)
{
    float dt = step_length / ray.slant;
    vec3 sum = vec3(0.0);
    float left = 1.0, t = ray.begin, share, f = field_at(ray_at(ray, t));
    float next = t + dt * (jitter != 0u ? pixel_noise(gl_FragCoord.xy) : 1.0);
    half_way = 0.0;
    while (t < ray.end && left > enough_light) {
        Piece piece = next_piece(ray, dt, t, f, next);
        float depth = piece.body + piece.skin;
        vec3 albedo = albedo_at(ray_at(ray, piece.at), share);
        float passed = exp(-depth * opacity_at(ray_at(ray, piece.at)));
        if (depth > 0.0)
            sum += left * (1.0 - passed) * glow_at(ray, piece.at, albedo, piece.skin / depth);
        left *= passed;
        half_way = half_way == 0.0 && left < 0.5 ? piece.at : half_way;
    }
    return vec4(sum, 1.0 - left);
}
