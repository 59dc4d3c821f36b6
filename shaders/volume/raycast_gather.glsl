// The light that a ray gathers through translucent fluid, from front to back. Wants volume/raycast_surface.glsl for `steps` and
// volume/raycast_light.glsl. After: Max, Optical models for direct volume rendering, 1995.
#include "common/noise.glsl"

// What a piece of fluid sends to the eye: its skin as a lit surface, its body evenly, as light in it comes from everywhere.
vec3 glow_at(Ray ray, float t, vec3 albedo, float skin)
{
    vec3 place = ray.from + t * ray.to, skinned = vec3(0.0);
    if (shading < 0.5)
        return albedo;
    float lit = lit_at(place), key = key_at(place, lit);
    if (skin > 0.0)
        skinned = phong(Surface(place, ray.to / ray.slant, normal_at(ray, t), albedo, lit, key, 0.0));
    vec3 sky = mix(ground_color, sky_color, 0.5) * (0.35 + 0.65 * lit);
    return mix(albedo * (sky + 0.5 * key * light_color), skinned, skin);
}

// Of a part of the ray: optical depths of body and skin, and where it is in the mean.
struct Piece {
    float body, skin, at;
};

// The field's place on the ramp of the transfer function.
float ramp_of(float f)
{
    return clamp((f - ramp_begin) * ramp_scale, 0.0, 1.0);
}

// Marches on from t, where the field is f, until there is enough to be worth shading. Extinction is taken as linear between samples,
// and that of the skin goes with the ramp's rise or fall: neither depends on how far apart samples are.
Piece next_piece(Ray ray, float dt, inout float t, inout float f, inout float next)
{
    const float enough = 0.1; // a tenth of the opacity, and half of the skin
    Piece piece = Piece(0.0, 0.0, 0.0);
    float ramp = ramp_of(f);
    while (t < ray.end && piece.body < enough && piece.skin <= skin_depth * 0.5) {
        next = min(next, ray.end);
        f = field_at(ray_at(ray, next));
        float after = ramp_of(f), body = 0.5 * (ramp + after) * (next - t) * ray.slant * extinction,
              skin = abs(after - ramp) * skin_depth;
        piece.body += body;
        piece.skin += skin;
        piece.at += (body + skin) * 0.5 * (t + next);
        steps++;
        ramp = after, t = next, next += max(dt, f < ramp_begin ? step_from(f, ramp_begin) / ray.slant : 0.0);
    }
    piece.at /= max(piece.body + piece.skin, 1e-30);
    return piece;
}

// Premultiplied colour and opacity. `half_way`: t at which half of the light is lost; 0: never.
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
        float passed = exp(-depth * mix(1.0, share, scalar_share));
        if (depth > 0.0)
            sum += left * (1.0 - passed) * glow_at(ray, piece.at, albedo, piece.skin / depth);
        left *= passed;
        half_way = half_way == 0.0 && left < 0.5 ? piece.at : half_way;
    }
    return vec4(sum, 1.0 - left);
}
