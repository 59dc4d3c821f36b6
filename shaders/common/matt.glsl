// The light of a solid's matt surface, with shadows of fluid and solids. Needs common/light.glsl, common/solid_light.glsl.
const float exposure = 0.8; // white facing sky and key light just reaches the screen's white

// The fluid's shadow has a rim of one texel, visible on smooth surfaces: takes the mean over a few texels.
float soft_fluid_light(vec3 in_eye)
{
    const int taps = 4;
    vec3 at = (eye_to_light * vec4(in_eye, 1.0)).xyz;
    float sum = 0.0;
    for (int i = 0; i < taps; i++) { // sunflower pattern: even over the disc
        float angle = 2.39996 * float(i), reach = 2.0 * shadow_texel() * sqrt((float(i) + 0.5) / float(taps));
        sum += fluid_light_at(at + vec3(reach * cos(angle), reach * sin(angle), 0.0));
    }
    return sum / float(taps);
}

vec3 matt(vec3 in_eye, vec3 normal, vec3 albedo)
{
    vec3 off = in_eye + shadow_texel() * light_depth * normal; // a texel off the surface, to reduce self-shadowing
    float lit = mix(soft_fluid_light(off), 1.0, fluid_clear), key = lit * solid_light(off) * max(dot(normal, light_in_eye), 0.0);
    vec3 light = ambient_light(normal) * (0.6 + 0.4 * lit) + light_color * key;
    return albedo * mix(vec3(1.0), exposure * light, shading);
}
