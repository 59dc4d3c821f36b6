// The light of a solid's surface: matt, with a highlight, and with shadows of fluid and solids. Needs common/light.glsl,
// common/solid_light.glsl, common/surface.glsl.
const float exposure = 0.8; // white facing sky and key light just reaches the screen's white
const float gloss = 0.35;   // the highlight, of the key light

vec3 solid_surface(vec3 in_eye, vec3 normal, vec3 albedo)
{
    vec3 off = in_eye + shadow_texel() * light_depth * normal; // a texel off the surface, to reduce self-shadowing
    float lit = mix(soft_fluid_light((eye_to_light * vec4(off, 1.0)).xyz), 1.0, fluid_clear), key = lit * solid_light(off);
    float glint = lobe_32(max(dot(reflect(normalize(in_eye), normal), light_in_eye), 0.0));
    vec3 light = ambient_light(normal) * (0.6 + 0.4 * lit) + light_color * (key * max(dot(normal, light_in_eye), 0.0));
    return mix(albedo, exposure * (albedo * light + light_color * (gloss * key * glint)), shading);
}
