// Inputs of shading a smooth surface in a pixel, and shared functions. Everything is in the eye's frame.
struct Surface {
    vec3 place; // m
    vec3 view;  // unit vector from the eye to the place
    vec3 normal;
    vec3 albedo;
    float lit;       // fraction of the key light after the fluid
    float key;       // fraction of the key light after fluid and solids
    float thickness; // length of fluid on the ray, m; 0 with phong
    float bare;      // 0 behind a pane of glass, where the glass alone mirrors; else 1
};

float lobe_32(float cosine) // cosine^32
{
    cosine *= cosine, cosine *= cosine, cosine *= cosine, cosine *= cosine;
    return cosine * cosine;
}

// After: Phong, Illumination for computer generated pictures, 1975.
vec3 phong(Surface s)
{
    float to_light = dot(s.normal, light_in_eye);
    float glint = lobe_32(max(dot(2.0 * to_light * s.normal - light_in_eye, -s.view), 0.0));
    vec3 sky = ambient_light(s.normal) * (0.35 + 0.65 * s.lit);
    return s.albedo * sky + light_color * (s.key * (s.albedo * max(to_light, 0.0) + 0.35 * glint));
}
