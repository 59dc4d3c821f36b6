// Soft daylight: a key light with shadow, sky above, ground below.
layout(binding = 0) uniform sampler2D shadow_map; // reversed: 1 next to the light; 0 where nothing casts

// How much of the key light reaches a point inside the fluid. Not a yes or no: it fades with the depth below the first
// lit surface, as in a cloudy liquid, which is soft, needs no bias and costs one texel.
float fluid_light_at(vec3 at)
{
    float below = (textureLod(shadow_map, at.xy, 0.0).x - at.z) * lens.w;
    return 0.12 + 0.88 * exp2(-0.55 * max(below - particle.z, 0.0) / max(particle.z, 1e-9));
}

float fluid_light(vec3 in_eye)
{
    return fluid_light_at((eye_to_light * vec4(in_eye, 1.0)).xyz);
}

vec3 ambient_light(vec3 normal)
{
    return mix(ground_color.rgb, sky_color.rgb, 0.5 + 0.5 * dot(normal, up_in_eye.xyz));
}
